// SPDX-License-Identifier: MIT
#include "scenes.hpp"

namespace testbed {

template std::unique_ptr<AnyScene> make_scene_of<moreau::Polygon<double>>(SceneKind,
                                                                          const Settings&);
template std::unique_ptr<AnyScene> make_scene_of<moreau::Disk<double>>(SceneKind, const Settings&);
template std::unique_ptr<AnyScene> make_scene_of<moreau::Compound<moreau::Polygon<double>>>(
    SceneKind, const Settings&);

}  // namespace testbed
