// SPDX-License-Identifier: MIT
// ParaView files and pictures of a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "moreau/io/csv.hpp"
#include "moreau/io/vtk.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/picture/render_packing.hpp"

#include "experiment.hpp"

namespace ratcheting {

template <class ExperimentT>
class Views {
 public:
  using S = typename ExperimentT::S;

  Views(const ExperimentT& experiment, double step, const std::filesystem::path& folder)
      : experiment_(experiment),
        step_(step),
        folder_(folder),
        grains_(folder / "grains.pvd"),
        contacts_(folder / "contacts.pvd") {}

  /// Writes vtk/grains_NNNN.vtp with velocities and vtk/contacts_NNNN.vtp with forces, and adds
  /// them to their series.
  void snapshot(int number) {
    std::filesystem::create_directories(folder_ / "vtk");
    char name[32];
    std::snprintf(name, sizeof name, "_%04d.vtp", number);
    const std::string grains = std::string("vtk/grains") + name;
    const std::string contacts = std::string("vtk/contacts") + name;
    const auto& simulation = experiment_.simulation();
    writer_.write_grains(folder_ / grains, simulation.grain_count(), shape(), pose(),
                         [&](std::size_t k) -> const typename S::Twist& {
                           return simulation.bodies().velocity[simulation.grain(k).index()];
                         });
    moreau::contact_segments<S>(simulation.contacts(), step_, position(), is_grain(), segments_);
    writer_.write_contacts(folder_ / contacts, segments_);
    grains_.add(experiment_.time(), grains);
    contacts_.add(experiment_.time(), contacts);
  }

  /// Writes chains.csv, or a file with a suffix in its name: the contacts with a force in the
  /// middle quarter of the box, as lines from centre to centre (x to the right, z up).
  void write_chains(const std::string& suffix) {
    constexpr double section = 0.25;
    const auto& simulation = experiment_.simulation();
    moreau::force_chains<S>(simulation.contacts(), step_, position(), is_grain(), segments_);
    moreau::CsvWriter file(folder_ / ("chains" + suffix + ".csv"),
                           {"x_from", "z_from", "x_to", "z_to", "normal_force"});
    const auto box = experiment_.box();
    for (const auto& chain : segments_) {
      bool inside = true;
      for (int k = 1; k + 1 < S::dim; ++k) {
        const double share = (chain.point[k] - box.lower[k]) / (box.upper[k] - box.lower[k]);
        inside = inside && std::abs(share - 0.5) <= section / 2;
      }
      if (inside)
        file.row(chain.from[0], chain.from[S::dim - 1], chain.to[0], chain.to[S::dim - 1],
                 chain.normal_force);
    }
    file.close();
  }
  /// The series of grains and of contacts, as members of a checkpoint.
  moreau::PvdSeries& grains() { return grains_; }
  moreau::PvdSeries& contacts() { return contacts_; }

  /// Draws packing.png and force_chains.png, or files with a suffix in their names.
  void picture(const std::string& suffix) {
    const auto& simulation = experiment_.simulation();
    moreau::force_chains<S>(simulation.contacts(), step_, position(), is_grain(), segments_);
    const auto color = [&](std::size_t k) {
      const double radius = double(simulation.shape_of_grain(k).circumradius());
      return moreau::rendering::stone_color((2 * radius / largest() - 0.5) * 2, k);
    };
    moreau::rendering::write_png(
        folder_ / ("packing" + suffix + ".png"),
        moreau::rendering::render_packing(experiment_.box(), simulation.grain_count(), shape(),
                                          pose(), color));
    moreau::rendering::write_png(
        folder_ / ("force_chains" + suffix + ".png"),
        moreau::rendering::render_force_chains<S>(experiment_.box(), segments_));
  }

 private:
  auto shape() const {
    return [this](std::size_t k) -> const typename ExperimentT::Shape& {
      return experiment_.simulation().shape_of_grain(k);
    };
  }
  auto pose() const {
    return [this](std::size_t k) -> const moreau::Pose<S>& {
      return experiment_.simulation().pose(experiment_.simulation().grain(k));
    };
  }
  auto position() const {
    return [this](std::size_t body) -> const typename S::Vector& {
      return experiment_.simulation().bodies().pose[body].position;
    };
  }
  auto is_grain() const {
    return [this](std::size_t body) { return experiment_.simulation().is_grain(body); };
  }
  /// Circumdiameter of the largest grain [m].
  double largest() const {
    double radius = 0;
    for (std::size_t k = 0; k < experiment_.simulation().grain_count(); ++k)
      radius = std::max(radius, double(experiment_.simulation().shape_of_grain(k).circumradius()));
    return 2 * radius;
  }

  const ExperimentT& experiment_;
  double step_;
  std::filesystem::path folder_;
  moreau::VtkWriter<S> writer_;
  moreau::PvdSeries grains_, contacts_;
  std::vector<moreau::ContactSegment<S>> segments_;
};

}  // namespace ratcheting
