// SPDX-License-Identifier: MIT
// Serialization of objects to bytes and back. transfer(archive, object) visits all numbers of an
// object in a fixed order. There are three archives: one writes the numbers, one reads them, and
// one records only their types. All three use the same function transfer(), so that reading cannot
// disagree with writing.
//
// Numbers are stored in the byte order of the machine. core/serialize.hpp describes how a class
// supports serialization.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/crc64.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"

namespace moreau::detail {

/// An object that converts to any member of an aggregate. It is used only in unevaluated
/// expressions, to count members.
struct AnyMember {
  template <class Member>
  operator Member() const;  // NOLINT(google-explicit-constructor): it stands for an initializer
};
template <class X, std::size_t... Member>
constexpr bool takes_members(std::index_sequence<Member...>) {
  return requires {
    X{(static_cast<void>(Member), AnyMember{})...};
  };
}
/// The number of members of an aggregate with at most Most members.
template <class X, std::size_t Most = 8>
constexpr std::size_t member_count() {
  if constexpr (Most == 0)
    return 0;
  else if constexpr (takes_members<X>(std::make_index_sequence<Most>{}))
    return Most;
  else
    return member_count<X, Most - 1>();
}
/// References to all members of an aggregate.
template <class X>
auto members(X& x) {
  constexpr std::size_t count = std::is_aggregate_v<X> ? member_count<X>() : 0;
  static_assert(count > 0,
                "a serializable class needs serialized_members(), see core/serialize.hpp");
  if constexpr (count == 0) {
    return std::tuple<>();
  } else if constexpr (count == 1) {
    auto& [a] = x;
    return std::tie(a);
  } else if constexpr (count == 2) {
    auto& [a, b] = x;
    return std::tie(a, b);
  } else if constexpr (count == 3) {
    auto& [a, b, c] = x;
    return std::tie(a, b, c);
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = x;
    return std::tie(a, b, c, d);
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = x;
    return std::tie(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = x;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = x;
    return std::tie(a, b, c, d, e, f, g);
  } else {
    auto& [a, b, c, d, e, f, g, h] = x;
    return std::tie(a, b, c, d, e, f, g, h);
  }
}

template <class X>
concept Number = std::is_arithmetic_v<X> || std::is_enum_v<X>;
template <class X>
concept EigenArray = std::derived_from<X, Eigen::PlainObjectBase<typename X::PlainObject>>;
/// A random number generator, whose state the standard library writes as text.
template <class X>
concept RandomEngine = std::uniform_random_bit_generator<X> && requires(X x, std::stringstream s) {
  s << x;
  s >> x;
};
template <class X>
inline constexpr bool is_list = false;
template <class X>
inline constexpr bool is_list<std::vector<X>> = true;
template <class X, std::size_t Alignment>
inline constexpr bool is_list<List<X, Alignment>> = true;
template <class X>
inline constexpr bool is_list<std::deque<X>> = true;
template <>
inline constexpr bool is_list<std::string> = true;
template <class X>
inline constexpr bool is_array = false;
template <class X, std::size_t Count>
inline constexpr bool is_array<std::array<X, Count>> = true;
template <class X>
inline constexpr bool is_variant = false;
template <class... Kinds>
inline constexpr bool is_variant<std::variant<Kinds...>> = true;

/// Visits all numbers of x.
template <class Archive, class X>
MOREAU_COLD void transfer(Archive& archive, X& x) {
  if constexpr (Number<X>) {
    archive.number(x);
  } else if constexpr (EigenArray<X>) {
    archive.extent(x);
    for (Eigen::Index i = 0; i < x.size(); ++i) archive.number(x.data()[i]);
  } else if constexpr (requires { x.coeffs(); }) {  // Quaternion
    transfer(archive, x.coeffs());
  } else if constexpr (requires { x.smallestPositiveAngle(); }) {  // Rotation2D
    archive.number(x.angle());
  } else if constexpr (is_list<X>) {
    archive.list(x);
  } else if constexpr (is_array<X>) {
    for (auto& item : x) transfer(archive, item);
  } else if constexpr (is_variant<X>) {
    archive.choice(x);
  } else if constexpr (RandomEngine<X>) {
    archive.text(x);
  } else if constexpr (SerializationAccess::is_serializable<X>()) {
    std::apply([&](auto&... part) { (transfer(archive, part), ...); },
               SerializationAccess::serialized_members(x));
    archive.done(x);
  } else if constexpr (!std::is_empty_v<X>) {
    std::apply([&](auto&... part) { (transfer(archive, part), ...); }, members(x));
  }
}

/// An archive that appends the numbers of objects to `bytes`. It does not change the objects.
class ArchiveWriter {
 public:
  std::string bytes;

  void number(const auto& x) { bytes.append(reinterpret_cast<const char*>(&x), sizeof x); }
  template <class X>
  void extent(X& x) {
    if constexpr (X::SizeAtCompileTime == Eigen::Dynamic) {
      number(static_cast<std::uint64_t>(x.rows()));
      number(static_cast<std::uint64_t>(x.cols()));
    }
  }
  void list(auto& items) {
    number(static_cast<std::uint64_t>(items.size()));
    for (auto& item : items) transfer(*this, item);
  }
  void choice(auto& variant) {
    number(static_cast<std::uint64_t>(variant.index()));
    std::visit([this](auto& kind) { transfer(*this, kind); }, variant);
  }
  void text(auto& engine) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << engine;
    std::string state = out.str();
    list(state);
  }
  void done(auto&) {}
};

/// An archive that reads the bytes of an ArchiveWriter. It throws std::runtime_error if the bytes
/// cannot represent the object. It allocates at most a few times the number of bytes.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : left_(bytes) {}

  std::size_t left() const { return left_.size(); }

  template <class X>
  void number(X& x) {
    if (sizeof x > left_.size()) throw std::runtime_error("ends within an object");
    if constexpr (std::same_as<X, bool>) {
      if (static_cast<unsigned char>(left_[0]) > 1)
        throw std::runtime_error("has a bool that is neither 0 nor 1");
      x = left_[0] != 0;
    } else {
      std::memcpy(&x, left_.data(), sizeof x);
    }
    left_.remove_prefix(sizeof x);
  }
  template <class X>
  void extent(X& x) {
    if constexpr (X::SizeAtCompileTime == Eigen::Dynamic) {
      const std::size_t rows = count(), columns = count();
      const auto fits = [](std::size_t n, Eigen::Index fixed) {
        return fixed == Eigen::Dynamic || n == static_cast<std::size_t>(fixed);
      };
      if (!fits(rows, X::RowsAtCompileTime) || !fits(columns, X::ColsAtCompileTime) ||
          (columns > 0 && rows > left_.size() / columns))
        throw std::runtime_error("has a matrix with an impossible number of rows or columns");
      x.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    }
  }
  template <class List>
  void list(List& items) {
    using Item = typename List::value_type;
    items.clear();
    for (std::size_t more = count(!std::is_empty_v<Item>); more > 0; --more) {
      items.push_back(SerializationAccess::blank<Item>());
      transfer(*this, items.back());
    }
  }
  template <class... Kinds>
  void choice(std::variant<Kinds...>& variant) {
    std::uint64_t index = 0, kind = 0;
    number(index);
    if (index >= sizeof...(Kinds))
      throw std::runtime_error("has an index of a type that does not exist");
    const auto take = [&]<class Kind>(std::in_place_type_t<Kind>) {
      if (kind++ == index) transfer(*this, variant.template emplace<Kind>(blank<Kind>()));
    };
    (take(std::in_place_type<Kinds>), ...);
  }
  template <class Engine>
  void text(Engine& engine) {
    std::string state;
    list(state);
    std::istringstream in(state);
    in.imbue(std::locale::classic());
    if (!(in >> engine))
      throw std::runtime_error("has no valid state of a random number generator");
  }
  template <class X>
  void done(X& x) {
    SerializationAccess::deserialized(x);
  }

 private:
  template <class X>
  static X blank() {
    return SerializationAccess::blank<X>();
  }
  /// Reads the size of a list. If each item has at least one byte, a size larger than the rest of the
  /// bytes is an error. Items without members, such as laws of one's own, have none.
  std::size_t count(bool has_bytes = true) {
    std::uint64_t count = 0;
    number(count);
    if (count > (has_bytes ? left_.size() : most_empty))
      throw std::runtime_error("ends within a list");
    return static_cast<std::size_t>(count);
  }
  static constexpr std::size_t most_empty = 1u << 24;

  std::string_view left_;
};

/// An archive that records the types of all numbers of an object. Two objects of the same type have
/// the same outline, unless the members of the type differ between two versions of the program.
class ArchiveOutline {
 public:
  std::uint64_t checksum() const { return crc64(kinds_); }

  template <class X>
  void number(const X&) {
    kinds_ += std::is_floating_point_v<X> ? 'f' : 'i';
    kinds_ += static_cast<char>('0' + sizeof(X));
  }
  void extent(const auto&) { kinds_ += 'm'; }
  template <class List>
  void list(List&) {
    auto item = SerializationAccess::blank<typename List::value_type>();
    kinds_ += '[';
    transfer(*this, item);
    kinds_ += ']';
  }
  template <class... Kinds>
  void choice(std::variant<Kinds...>&) {
    const auto note = [&]<class Kind>(std::in_place_type_t<Kind>) {
      Kind kind = SerializationAccess::blank<Kind>();
      kinds_ += '|';
      transfer(*this, kind);
    };
    (note(std::in_place_type<Kinds>), ...);
  }
  void text(auto&) { kinds_ += 't'; }
  void done(auto&) {}

 private:
  std::string kinds_;
};

}  // namespace moreau::detail
