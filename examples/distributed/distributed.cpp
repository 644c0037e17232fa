// SPDX-License-Identifier: MIT
// Grains fall into a box. The program runs in any number of processes:
//
//   mpirun -n 2 distributed [GRAINS [STEPS [FOLDER [SNAPSHOT]]]]     500, 1000, distributed-output
//
// It writes FOLDER/packing.snapshot and, for ParaView, the series FOLDER/grains.pvd and contacts.pvd. If
// it is started again, it continues from FOLDER/packing.snapshot for STEPS more steps, also with another
// number of processes. GRAINS must then be the number of grains of the snapshot. With SNAPSHOT it begins
// from that file instead.
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <moreau/distributed/distributed_simulation.hpp>
#include <moreau/distributed/write_pieces.hpp>
#include <moreau/io/snapshot.hpp>
#include <moreau/law/compliant.hpp>
#include <moreau/moreau.hpp>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

namespace fs = std::filesystem;

// Or moreau::Polygon<double>, moreau::Ball<double>, moreau::Disk<double>:
using Shape = moreau::Polyhedron<double>;
using S = moreau::SpaceOf<Shape>;
using Law = moreau::Compliant<>;
using World = moreau::Simulation<Shape, Law>;
constexpr double size = 0.02, step = 2e-4;  // [m], [s]

/// Cubes with random rotations on a lattice, above the floor of a box.
void build(World& world, std::size_t count) {
  constexpr int up = S::dim - 1;
  const auto wide = std::size_t(std::ceil(std::pow(double(count) / 2, 1.0 / S::dim)));
  const double pitch = 1.8 * size, length = pitch * double(wide);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-1, 1);
  const moreau::ShapeId shape = world.add_shape(moreau::regular_shape<Shape>(size));
  for (std::size_t k = 0; k < count; ++k) {
    moreau::Pose<S> pose;
    std::size_t rest = k;
    for (int axis = 0; axis < up; ++axis, rest /= wide)
      pose.position[axis] = pitch * (double(rest % wide) + 0.5);
    pose.position[up] = pitch * (double(rest) + 0.5);
    pose.rotation = S::exp(S::Angular::Constant(angle(random)));
    world.add_grain(shape, pose, 2700);
  }
  for (int axis = 0; axis < S::dim; ++axis) {
    const S::Vector normal = S::Vector::Unit(axis);
    world.add_wall(normal, S::Vector::Zero());
    if (axis < up) world.add_wall(-normal, length * normal);
  }
  world.set_gravity(-9.81 * S::Vector::Unit(up));
}

struct Arguments {
  std::optional<std::size_t> grains;  // 500 unless given, or those of the snapshot
  std::size_t steps = 1000;
  fs::path folder = "distributed-output", from;  // from: a snapshot; empty unless given
};

/// The file series of a run. They are in its snapshot, so that a run that continues appends to them.
struct Series {
  explicit Series(const fs::path& folder)
      : grains(folder / "grains.pvd"), contacts(folder / "contacts.pvd") {}
  moreau::PvdSeries grains, contacts;
  int frames = 0;  // written
};

/// The name of the files of a frame: packing_000012.
std::string name_of(int frame) {
  char text[32];
  std::snprintf(text, sizeof text, "packing_%06d", frame);
  return text;
}

/// Removes the frames that an earlier run in this folder wrote after its snapshot, or for another run.
void remove_frames_from(int first, const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("packing_") && name.substr(0, name_of(0).size()) >= name_of(first))
      fs::remove(entry.path());
  }
}

/// Reads the snapshot that is named or that is in the folder; builds the packing if there is none.
void begin(World& world, Series& series, const Arguments& arguments) {
  fs::create_directories(arguments.folder);
  const fs::path own = arguments.folder / "packing.snapshot";
  const fs::path file = arguments.from.empty() ? own : arguments.from;
  if (!arguments.from.empty() || fs::exists(own)) {
    moreau::read_snapshot(file, world, series.grains, series.contacts, series.frames);
    if (arguments.grains && world.grain_count() != *arguments.grains)
      throw std::invalid_argument(file.string() + " has " + std::to_string(world.grain_count()) +
                                  " grains, not " + std::to_string(*arguments.grains) +
                                  ": give this number, or another folder");
    std::printf("continuing from t = %.4f s of %s\n", world.time(), file.string().c_str());
  } else {
    build(world, arguments.grains.value_or(500));
  }
  remove_frames_from(series.frames, arguments.folder);
}

void run(moreau::Communicator& all, const Arguments& arguments) {
  const fs::path& folder = arguments.folder;

  // The same simulation in all processes; its content comes from the first.
  World world(size, moreau::Materials<Law>(1, Law(moreau::SignoriniCoulomb<>(0.5), 1e7)));
  Series series(folder);
  if (all.rank() == 0) begin(world, series, arguments);
  series.frames = int(all.sum(series.frames));  // that of the first process; 0 in all others
  moreau::DistributedSimulation<World> packing(MPI_COMM_WORLD, std::move(world));

  for (std::size_t k = 1; k <= arguments.steps; ++k) {
    const moreau::StepReport report = packing.step(step);
    if (k % 100 != 0 && k != arguments.steps) continue;
    const moreau::DistributionReport own = packing.distribution();
    if (all.rank() == 0)
      std::printf("t = %.2f s: %zu points, %d sweeps, residual %.1e, %zu grains in process 0\n",
                  packing.time(), report.points, report.solve.sweeps, report.solve.residual,
                  own.grains);
    const std::string name = name_of(series.frames++);
    moreau::write_pieces(folder / name, packing, step);
    if (const std::optional<World> whole = packing.gather()) {  // on the first process
      series.grains.add(packing.time(), name + "_grains.pvtp");
      series.contacts.add(packing.time(), name + "_contacts.pvtp");
      moreau::write_snapshot(folder / "packing.snapshot", *whole, series.grains, series.contacts,
                             series.frames);
    }
  }
}

/// A positive whole number, and nothing behind it.
std::size_t number(std::string_view text, const char* what) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value == 0)
    throw std::invalid_argument(std::string(what) + " is '" + std::string(text) +
                                "': it must be a whole number of at least 1");
  return value;
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  if (argc > 5)
    throw std::invalid_argument("usage: distributed [GRAINS [STEPS [FOLDER [SNAPSHOT]]]]");
  if (argc > 1) arguments.grains = number(argv[1], "GRAINS");
  if (argc > 2) arguments.steps = number(argv[2], "STEPS");
  if (argc > 3) arguments.folder = argv[3];
  if (argc > 4) arguments.from = argv[4];
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  const moreau::MpiSession mpi(argc, argv);
  moreau::Communicator all;
  Arguments arguments;
  try {
    arguments = parse(argc, argv);
  } catch (const std::exception& error) {
    if (all.rank() == 0) std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  try {
    run(all, arguments);
  } catch (const std::exception& error) {
    all.end_all(error.what());
  }
}
