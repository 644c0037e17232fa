// SPDX-License-Identifier: MIT
#include "scenes.hpp"

namespace testbed {

template std::unique_ptr<AnyScene> make_scene_of<moreau::Polyhedron<double>>(SceneKind,
                                                                             const Settings&);
template std::unique_ptr<AnyScene> make_scene_of<moreau::Ball<double>>(SceneKind, const Settings&);
template std::unique_ptr<AnyScene> make_scene_of<moreau::Compound<moreau::Polyhedron<double>>>(
    SceneKind, const Settings&);

}  // namespace testbed
