// SPDX-License-Identifier: MIT
// A list whose memory is handled by functions that are compiled once for all types of elements. A
// std::vector brings some 65 functions per type of its elements to a unit, this list about 15: a simulation
// has 60 such types, and the compile time of a unit follows the number of its functions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "moreau/core/compiled_once.hpp"

namespace moreau {
namespace detail {

/// Memory of `capacity` elements of `bytes` each, of which the first `used` bytes are those of `old`, which
/// is freed.
MOREAU_COLD inline void* moved_memory(void* old, std::size_t used, std::size_t capacity,
                                      std::size_t bytes, std::size_t alignment) {
  if (capacity > std::size_t(-1) / 2 / bytes) throw std::length_error("List: too long");
  void* const data = ::operator new(capacity* bytes, std::align_val_t(alignment));
  if (used != 0) std::memcpy(data, old, used);
  if (old != nullptr) ::operator delete(old, std::align_val_t(alignment));
  return data;
}

}  // namespace detail

/// A std::vector of elements that may be copied as bytes and need no destructor: numbers, fixed-size matrices, and
/// structs of them. It has the types and functions of std::vector that the library and its examples use, with the same
/// meaning. Iterators are pointers.
/// @tparam Alignment of the memory [byte]
template <class T, std::size_t Alignment = alignof(T)>
class List {
 public:
  /// @cond vector
  using value_type = T;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using reference = T&;
  using const_reference = const T&;
  using iterator = T*;
  using const_iterator = const T*;

  List() = default;
  explicit List(std::size_t count) { resize(count); }
  List(std::size_t count, const T& value) { assign(count, value); }
  List(std::initializer_list<T> items) { append(items.begin(), items.size()); }
  List(const List& other) { append(other.data_, other.size_); }
  List(List&& other) noexcept { swap(other); }
  List& operator=(const List& other) {
    if (this != &other) {
      size_ = 0;
      append(other.data_, other.size_);
    }
    return *this;
  }
  List& operator=(List&& other) noexcept {
    swap(other);
    return *this;
  }
  ~List() {
    static_assert(std::is_trivially_destructible_v<T>, "List: elements without a destructor");
    if (data_ != nullptr) ::operator delete(data_, std::align_val_t(Alignment));
  }

  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  /// @throws std::out_of_range unless i < size()
  const T& at(std::size_t i) const {
    if (i >= size_) throw std::out_of_range("List::at: the index must be below size()");
    return data_[i];
  }
  T& at(std::size_t i) { return const_cast<T&>(std::as_const(*this).at(i)); }
  auto rbegin() const { return std::make_reverse_iterator(end()); }
  auto rend() const { return std::make_reverse_iterator(begin()); }
  T& front() { return data_[0]; }
  const T& front() const { return data_[0]; }
  T& back() { return data_[size_ - 1]; }
  const T& back() const { return data_[size_ - 1]; }

  void clear() { size_ = 0; }
  void pop_back() { --size_; }
  void reserve(std::size_t capacity) {
    if (capacity > capacity_) move_to(capacity);
  }
  void resize(std::size_t size) {
    if (size > capacity_) move_to(std::max(size, 2 * capacity_));
    for (std::size_t i = size_; i < size; ++i) ::new (static_cast<void*>(data_ + i)) T();
    size_ = size;
  }
  /// As above. `value` may be an element of this list.
  void resize(std::size_t size, const T& value) {
    if (size <= size_) {
      size_ = size;
      return;
    }
    const T copy = value;
    if (size > capacity_) move_to(std::max(size, 2 * capacity_));
    for (; size_ < size; ++size_) ::new (static_cast<void*>(data_ + size_)) T(copy);
  }
  void assign(std::size_t size, const T& value) {
    const T copy = value;
    size_ = 0;
    resize(size, copy);
  }
  template <std::input_iterator Iterator>
  void assign(Iterator first, Iterator last) {
    size_ = 0;
    for (; first != last; ++first) push_back(*first);
  }
  /// `value` may be an element of this list.
  void push_back(const T& value) {
    if (size_ == capacity_) {
      const T copy = value;
      move_to(2 * capacity_ + 1);
      ::new (static_cast<void*>(data_ + size_++)) T(copy);
    } else {
      ::new (static_cast<void*>(data_ + size_++)) T(value);
    }
  }
  template <class... Arguments>
  T& emplace_back(Arguments&&... arguments) {
    push_back(T(std::forward<Arguments>(arguments)...));
    return back();
  }
  /// `items` are not elements of this list.
  void append(const T* items, std::size_t count) {
    if (size_ + count > capacity_) move_to(std::max(size_ + count, 2 * capacity_));
    if (count != 0)
      std::memcpy(static_cast<void*>(data_ + size_), static_cast<const void*>(items),
                  count * sizeof(T));
    size_ += count;
  }
  T* erase(const T* first, const T* last) {
    T* const to = data_ + (first - data_);
    const std::size_t left = std::size_t(end() - last);
    if (left != 0)
      std::memmove(static_cast<void*>(to), static_cast<const void*>(last), left * sizeof(T));
    size_ -= std::size_t(last - first);
    return to;
  }
  T* erase(const T* item) { return erase(item, item + 1); }
  /// `value` is not an element of this list.
  T* insert(const T* before, const T& value) {
    const std::size_t at = std::size_t(before - data_);
    if (size_ == capacity_) move_to(2 * capacity_ + 1);
    std::memmove(static_cast<void*>(data_ + at + 1), static_cast<const void*>(data_ + at),
                 (size_ - at) * sizeof(T));
    ++size_;
    return ::new (static_cast<void*>(data_ + at)) T(value);
  }
  /// A copy, for interfaces that take a std::vector.
  template <class Allocator>
  operator std::vector<T, Allocator>() const {  // NOLINT(google-explicit-constructor)
    return std::vector<T, Allocator>(begin(), end());
  }
  void swap(List& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  friend void swap(List& a, List& b) noexcept { a.swap(b); }
  /// Removes the elements of which `is_gone` is true, and keeps the order of the others.
  friend std::size_t erase_if(List& items, const auto& is_gone) {
    T* const left = std::remove_if(items.begin(), items.end(), is_gone);
    const std::size_t count = std::size_t(items.end() - left);
    items.size_ -= count;
    return count;
  }
  friend bool operator==(const List& a, const List& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend bool operator==(const List& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  /// @endcond

 private:
  void move_to(std::size_t capacity) {
    data_ = static_cast<T*>(
        detail::moved_memory(data_, size_ * sizeof(T), capacity, sizeof(T), Alignment));
    capacity_ = capacity;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace moreau
