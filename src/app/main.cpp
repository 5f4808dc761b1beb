#include "app/command_line.hpp"
#include "app/messages.hpp"
#include "scene/input_error.hpp"

int main(int argc, char** argv) {
  using namespace vitrum::app;
  open_standard_streams();
  const int status = command_line(argc, argv);
  try {
    show("");  // some of what was printed reaches its file only now: the disk may be full
  } catch (const vitrum::FileError& error) {
    if (status == exit_done) {
      tell("error: {}\n", error.what());
      return exit_file;
    }
  }
  return status;
}
