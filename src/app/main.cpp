#include "app/command_line.hpp"
#include "app/messages.hpp"
#include "scene/input_error.hpp"

namespace {

/// Has the stack that the deepest calls take while there is memory: a stack that cannot grow later ends the
/// process by a signal, where everything else that wants memory is told.
void grow_stack() {
  constexpr int size = 512 * 1024, page = 4096;
  [[maybe_unused]] volatile char room[size];
  for (int at = 0; at < size; at += page) room[at] = 0;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace vitrum::app;
  grow_stack();
  open_standard_streams();
  const int status = command_line(argc, argv);
  try {
    show("");  // some of what was printed reaches its file only now: the disk may be full
  } catch (const vitrum::FileError& error) {
    if (status == exit_done) {
      complain(error.what());
      return exit_file;
    }
  }
  return status;
}
