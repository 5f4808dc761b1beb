#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vitrum {

/// The input is wrong (exit status 2). Carries every fault found, one single-line message each; what() joins
/// them by newlines.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages)
      : std::runtime_error(join(messages)), messages_(std::move(messages)) {}
  explicit InputError(std::string message) : InputError(std::vector<std::string>{std::move(message)}) {}

  const std::vector<std::string>& messages() const { return messages_; }

 private:
  static std::string join(const std::vector<std::string>& messages) {
    std::string text;
    for (const std::string& message : messages) {
      if (!text.empty()) text += '\n';
      text += message;
    }
    return text;
  }

  std::vector<std::string> messages_;
};

/// A file could not be read or written (exit status 4). The message names the file and the system's reason.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vitrum
