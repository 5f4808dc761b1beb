#include "failing_new.hpp"

#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr long never = std::numeric_limits<long>::max();
std::atomic<long> successes_left{never};
std::atomic<bool> fails_once{false};
int told_to = -1;

void* allocate(std::size_t size, std::size_t alignment) {
  if (successes_left.load(std::memory_order_relaxed) != never) {
    const long left = successes_left.fetch_sub(1);
    if (left == 0) (void)!write(told_to, "!", 1);
    if (left == 0 || (left < 0 && !fails_once)) throw std::bad_alloc();
  }
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = alignment <= alignof(std::max_align_t) ? std::malloc(size == 0 ? 1 : size)
                                                        : std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size, 1);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return allocate(size, 1);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace vitrum::test {

FailingNew::FailingNew(long successes, Failing failing, int told) {
  told_to = told;
  fails_once = failing == Failing::once;
  successes_left = successes;
}
FailingNew::~FailingNew() {
  successes_left = never;
}

}  // namespace vitrum::test
