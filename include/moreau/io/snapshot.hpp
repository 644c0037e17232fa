// SPDX-License-Identifier: MIT
// The state of a simulation in one file. A run that is stopped and restarted from the file
// continues with the same bits as a run without interruption.
//
//   write_snapshot("run.snapshot", simulation, steps, random);   // and other objects of the run
//
//   moreau::Simulation<..> simulation(..);                        // an empty one of the same type
//   if (resume) read_snapshot("run.snapshot", simulation, steps, random);
//   else        build(simulation);
//
// The file contains all data that the next step depends on: bodies, shapes as they were built,
// materials, walls, the periodic cell, the options of the solver, contacts with their impulses and
// the history variables of the contact laws, and the list of pairs with their caches. It does not
// contain functions of the user, such as the functions of drives, which get their time from the
// simulation. It does not contain the number of threads, on which the results do not depend.
//
//   "\x89MOREAU\n" | byte order | format | size of the file | outline of the objects
//   | version of moreau | types | objects | CRC-64 of all preceding bytes
//
// The checksum detects damage, but not manipulation. Read snapshots only from people whose programs
// you would run.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <cxxabi.h>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "moreau/core/archive.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/crc64.hpp"
#include "moreau/core/error.hpp"
#include "moreau/io/detail/input_file.hpp"
#include "moreau/io/output_file.hpp"
#include "moreau/version.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {

namespace detail {

/// The beginning of every snapshot, in every format.
struct SnapshotHead {
  static constexpr std::uint32_t this_order = 0x01020304, this_format = 1;

  std::array<char, 8> magic{'\x89', 'M', 'O', 'R', 'E', 'A', 'U', '\n'};
  std::uint32_t order = this_order, format = this_format;
  std::uint64_t size = 0;  ///< size of the file, including the checksum [bytes]
  std::uint64_t outline = 0;
};
static_assert(sizeof(SnapshotHead) == 32);

template <class Solver>
struct OptionsOf {
  using type = Solver;
};
template <class Solver>
requires requires {
  typename Solver::Options;
}
struct OptionsOf<Solver> {
  using type = typename Solver::Options;
};

/// The types of a snapshot. The broad phase and the team of threads are not part of a
/// snapshot.
template <class Simulation, class... More>
struct SnapshotTypes;
template <class ShapeT, class Law, class Integrator, class Broad, class Solver, class... More>
struct SnapshotTypes<Simulation<ShapeT, Law, Integrator, Broad, Solver>, More...> {
  using type = std::tuple<ShapeT, Law, Integrator, typename OptionsOf<Solver>::type, More...>;

  static std::string name() {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(
        abi::__cxa_demangle(typeid(type).name(), nullptr, nullptr, &status), &std::free);
    return text ? text.get() : typeid(type).name();
  }
};

/// The parts of reading and writing that depend on the type of the simulation alone. The functions are not inline: a
/// program can instantiate them in one source and declare them extern (moreau/instances).
template <class Archive, class Simulation>
MOREAU_COLD void transfer_simulation(Archive& archive, Simulation& simulation) {
  transfer(archive, simulation);
}
template <class Simulation>
MOREAU_COLD Simulation copy_of_simulation(const Simulation& simulation) {
  return simulation;
}
template <class Simulation>
MOREAU_COLD void replace_simulation(Simulation& simulation, Simulation& by) {
  simulation = std::move(by);
}

template <class Simulation, class... More>
MOREAU_COLD std::uint64_t outline_of(Simulation& simulation, More&... more) {
  ArchiveOutline outline;
  transfer_simulation(outline, simulation);
  (transfer(outline, more), ...);
  return outline.checksum();
}

/// The parts A, B<C, D>, ... of the text std::tuple<A, B<C, D>, ...>.
MOREAU_COLD inline std::vector<std::string_view> parts_of(std::string_view tuple) {
  const std::size_t first = tuple.find('<') + 1, last = tuple.rfind('>');
  if (first == 0 || last == tuple.npos || last < first) return {};
  std::vector<std::string_view> parts;
  std::size_t start = first;
  int depth = 0;
  for (std::size_t k = first; k <= last; ++k) {
    const char c = tuple[k];
    if (k == last || (c == ',' && depth == 0)) {
      parts.push_back(tuple.substr(start, k - start));
      while (!parts.back().empty() && parts.back().front() == ' ') parts.back().remove_prefix(1);
      while (!parts.back().empty() && parts.back().back() == ' ') parts.back().remove_suffix(1);
      start = k + 1;
    }
    depth += c == '<' || c == '(' || c == '[' || c == '{';
    depth -= c == '>' || c == ')' || c == ']' || c == '}';
  }
  return parts;
}

/// Describes the first difference between two lists of types.
MOREAU_COLD inline std::string difference(std::string_view found, std::string_view wanted) {
  constexpr std::array<std::string_view, 4> of_world{"shape", "law", "integrator",
                                                     "solver's options"};
  const std::vector<std::string_view> is = parts_of(found), want = parts_of(wanted);
  for (std::size_t k = 0; k < std::min(is.size(), want.size()); ++k) {
    if (is[k] == want[k]) continue;
    const std::string what = k < of_world.size()
                                 ? std::string(of_world[k])
                                 : "object " + std::to_string(k + 1 - of_world.size()) +
                                       " that goes with the simulation";
    return "holds " + std::string(is[k]) + ", not " + std::string(want[k]) + ", as its " + what;
  }
  if (is.size() < of_world.size() || is.size() == want.size()) return "holds other types";
  return "holds " + std::to_string(is.size() - of_world.size()) + " objects, not " +
         std::to_string(want.size() - of_world.size()) + ", that go with the simulation";
}

/// @throws std::runtime_error unless the bytes are a complete snapshot of the present format
MOREAU_COLD inline SnapshotHead checked_head(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const std::string& why) { throw std::runtime_error(name + why); };
  if (bytes.empty()) refuse(" is empty");
  SnapshotHead head;
  const std::string_view magic(head.magic.data(), head.magic.size());
  if (bytes.substr(0, magic.size()) != magic.substr(0, bytes.size()))
    refuse(" is no snapshot of moreau, or is corrupted");
  if (bytes.size() < sizeof head + sizeof(std::uint64_t))
    refuse(" is truncated: " + std::to_string(bytes.size()) + " bytes");
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.order != SnapshotHead::this_order)
    refuse(" was written on a machine with another order of bytes, or is corrupted");
  if (head.format != SnapshotHead::this_format)
    refuse(" has format " + std::to_string(head.format) +
           ", moreau " MOREAU_VERSION_STRING " reads " + std::to_string(SnapshotHead::this_format) +
           ", or is corrupted");
  if (head.size != bytes.size())
    refuse((bytes.size() < head.size ? " is truncated: " : " is too long: ") +
           std::to_string(bytes.size()) + " of " + std::to_string(head.size) +
           " bytes, or is corrupted");
  const std::string_view all_before = bytes.substr(0, bytes.size() - sizeof(std::uint64_t));
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + all_before.size(), sizeof checksum);
  if (checksum != crc64(all_before)) refuse(" is corrupted: its checksum does not fit");
  return head;
}

template <class Simulation, class... More>
MOREAU_COLD void restore(std::string_view bytes, const std::string& name, Simulation& simulation,
                         More&... more) {
  const SnapshotHead head = checked_head(bytes, name);
  bytes.remove_suffix(sizeof(std::uint64_t));
  ArchiveReader archive(bytes.substr(sizeof head));
  // The objects are read into copies, so that an error leaves the originals unchanged.
  Simulation loaded = copy_of_simulation(simulation);
  std::tuple<More...> loaded_more(more...);
  try {
    std::string version, types;
    transfer(archive, version);
    transfer(archive, types);
    const std::string wanted = SnapshotTypes<Simulation, More...>::name();
    if (types != wanted) throw std::runtime_error(difference(types, wanted));
    if (head.outline != outline_of(simulation, more...))
      throw std::runtime_error("was written by moreau " + version +
                               ", whose objects have other members than those of this " +
                               MOREAU_VERSION_STRING);
    transfer_simulation(archive, loaded);
    std::apply([&](auto&... one) { (transfer(archive, one), ...); }, loaded_more);
    if (archive.left() > 0) throw std::runtime_error("holds more than its objects");
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ' ' + error.what());
  }
  replace_simulation(simulation, loaded);
  std::tie(more...) = std::move(loaded_more);
}

}  // namespace detail

/// The state of a simulation as bytes. Two states give the same bytes if and only if they have the
/// same bits.
/// @param more other objects of the run: numbers, strings, vectors, random number generators,
///             classes with serialized_members(); see core/serialize.hpp
template <class ShapeT, class Law, class Integrator, class Broad, class Solver, class... More>
MOREAU_COLD std::string snapshot(
    const Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation, const More&... more) {
  using Whole = std::remove_cvref_t<decltype(simulation)>;
  // An archive takes references that are not const. This archive only reads the objects.
  auto& open = const_cast<Whole&>(simulation);
  detail::SnapshotHead head;
  head.outline = detail::outline_of(open, const_cast<More&>(more)...);
  detail::ArchiveWriter archive;
  archive.bytes.resize(sizeof head);
  std::string version = MOREAU_VERSION_STRING;
  std::string types = detail::SnapshotTypes<Whole, More...>::name();
  transfer(archive, version);
  transfer(archive, types);
  detail::transfer_simulation(archive, open);
  (transfer(archive, const_cast<More&>(more)), ...);
  head.size = archive.bytes.size() + sizeof(std::uint64_t);
  std::memcpy(archive.bytes.data(), &head, sizeof head);
  archive.number(detail::crc64(archive.bytes));
  return std::move(archive.bytes);
}

/// Restores the state of a simulation, and of other objects of the run, from the bytes of
/// snapshot(). It replaces everything in the simulation except the team of threads.
/// @param bytes the result of snapshot()
/// @param simulation a simulation of the same type as in snapshot(); it may be empty
/// @param more  objects of the same types and in the same order as in snapshot()
/// @throws std::runtime_error with the reason if the bytes are not a snapshot, are truncated or
///                            corrupted, or have a different format or different types; no object
///                            is changed then
template <class ShapeT, class Law, class Integrator, class Broad, class Solver, class... More>
void restore_snapshot(std::string_view bytes,
                      Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation,
                      More&... more) {
  detail::restore(bytes, "restore_snapshot: what is given", simulation, more...);
}

/// Writes a snapshot. An existing file is replaced as a whole: a reader finds the old file or the
/// new file, even if the program is killed while it writes.
/// @param more other objects of the run; see snapshot()
/// @throws std::system_error naming the path if the file cannot be written; an existing file is
///         then unchanged
template <class ShapeT, class Law, class Integrator, class Broad, class Solver, class... More>
void write_snapshot(const std::filesystem::path& path,
                    const Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation,
                    const More&... more) {
  write_atomically(path, snapshot(simulation, more...));
}

/// Restores a simulation of the same type, and other objects of the run, from a file written by write_snapshot(); see
/// restore_snapshot(). The file also sets what was set before: laws, gravity, options, tolerances, grain size. Change
/// them after this call (set_materials(), set_gravity(), set_solver(), ...).
/// @param simulation without bodies, which the file would replace; reload_snapshot() replaces them
/// @throws std::invalid_argument if the simulation has bodies
/// @throws std::system_error naming the path and the reason if the file cannot be read
/// @throws std::runtime_error naming the path and the reason if restore_snapshot() would throw; no
///                            object is changed then
template <class ShapeT, class Law, class Integrator, class Broad, class Solver, class... More>
void read_snapshot(const std::filesystem::path& path,
                   Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation, More&... more) {
  require(
      simulation.bodies().size() == 0, "read_snapshot", "bodies", simulation.bodies().size(),
      "must be 0, because the file replaces all of the simulation: read first, then add, or use "
      "reload_snapshot()");
  const std::string bytes = detail::read_file(path, "read_snapshot");
  detail::restore(bytes, "read_snapshot: '" + path.string() + "'", simulation, more...);
}

/// The same for a simulation that may have bodies: goes back to the state in the file.
/// @throws as read_snapshot(), except that bodies are no error
template <class ShapeT, class Law, class Integrator, class Broad, class Solver, class... More>
void reload_snapshot(const std::filesystem::path& path,
                     Simulation<ShapeT, Law, Integrator, Broad, Solver>& simulation,
                     More&... more) {
  const std::string bytes = detail::read_file(path, "reload_snapshot");
  detail::restore(bytes, "reload_snapshot: '" + path.string() + "'", simulation, more...);
}

}  // namespace moreau
