#pragma once

/// The operator new of this executable: it can be told to fail.
namespace vitrum::test {

enum class Failing { once, from_then_on };

/// While it exists, the allocation after `successes` successful ones throws std::bad_alloc; on any thread.
class FailingNew {
 public:
  /// A byte is written to the file descriptor `told` when an allocation fails.
  FailingNew(long successes, Failing failing, int told);
  ~FailingNew();
  FailingNew(const FailingNew&) = delete;
  FailingNew& operator=(const FailingNew&) = delete;
};

}  // namespace vitrum::test
