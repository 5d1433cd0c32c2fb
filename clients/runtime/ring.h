#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>

namespace semblante::runtime {

/// A queue in one piece of memory, which grows by doubling and never shrinks: once it has grown, neither end allocates.
/// `first_capacity`: of the first item on, a power of two.
template <class T, std::size_t first_capacity = 8>
class Ring {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }

  T& operator[](std::size_t i) { return assert(i < size_), items_[(first_ + i) & (capacity_ - 1)]; }
  const T& operator[](std::size_t i) const { return assert(i < size_), items_[(first_ + i) & (capacity_ - 1)]; }
  T& front() { return (*this)[0]; }
  T& back() { return (*this)[size_ - 1]; }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }

  T& push_back(T item) {
    if (size_ == capacity_) grow();
    T& place = items_[(first_ + size_) & (capacity_ - 1)];
    place = std::move(item);
    ++size_;
    return place;
  }
  void pop_front(std::size_t count = 1) {
    assert(count <= size_);
    first_ = (first_ + count) & (capacity_ - 1);
    size_ -= count;
  }
  void erase(std::size_t i) {
    for (; i + 1 < size_; ++i) (*this)[i] = std::move((*this)[i + 1]);
    --size_;
  }
  void clear() { first_ = size_ = 0; }

 private:
  void grow() {
    const std::size_t capacity = std::max(first_capacity, 2 * capacity_);
    auto items = std::make_unique<T[]>(capacity);
    for (std::size_t i = 0; i < size_; ++i) items[i] = std::move((*this)[i]);
    items_ = std::move(items);
    first_ = 0;
    capacity_ = capacity;
  }

  std::unique_ptr<T[]> items_;
  std::size_t first_ = 0, size_ = 0;
  std::size_t capacity_ = 0;  ///< 0 or a power of two
};

}  // namespace semblante::runtime
