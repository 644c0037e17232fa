// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "moreau/core/ids.hpp"
#include "moreau/distributed/communicator.hpp"
#include "moreau/distributed/detail/world_parts.hpp"

namespace moreau::detail {

/// The shapes that a process has during a redistribution, by their ids in the whole simulation.
template <class ShapeT>
class ShapeStore {
 public:
  /// Moves shapes into the store.
  /// @param ids one per shape
  void take(const std::vector<std::uint32_t>& ids, std::deque<ShapeT>& shapes) {
    for (std::size_t k = 0; k < ids.size(); ++k) shapes_.emplace(ids[k], std::move(shapes[k]));
  }
  ShapeT& operator[](ShapeId id) { return shapes_.at(id.value); }
  void clear() { shapes_.clear(); }

  /// Gets the shapes that are not in the store from the ranks that sent the grains. Communicates.
  /// @param from the grains that each rank sent
  template <class S>
  void fetch(const std::vector<BodyList<S>>& from, Communicator& processes) {
    std::vector<std::string> asked, answers;
    for (const BodyList<S>& grains : from) {
      std::vector<std::uint32_t> unknown;
      for (const ShapeId shape : grains.shapes)
        if (!shapes_.contains(shape.value)) unknown.push_back(shape.value);
      std::sort(unknown.begin(), unknown.end());
      unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
      asked.push_back(unknown.empty() ? std::string() : packed(unknown));
    }
    for (const std::string& question : processes.exchange(std::move(asked))) {
      std::vector<std::uint32_t> wanted;
      std::deque<ShapeT> shapes;
      if (!question.empty()) unpack(question, wanted);
      for (const std::uint32_t shape : wanted) shapes.push_back(shapes_.at(shape));
      answers.push_back(wanted.empty() ? std::string() : packed(wanted, shapes));
    }
    for (const std::string& answer : processes.exchange(std::move(answers))) {
      if (answer.empty()) continue;
      std::vector<std::uint32_t> wanted;
      std::deque<ShapeT> shapes;
      unpack(answer, wanted, shapes);
      take(wanted, shapes);
    }
  }

 private:
  std::map<std::uint32_t, ShapeT> shapes_;
};

}  // namespace moreau::detail
