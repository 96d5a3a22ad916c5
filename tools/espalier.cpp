/// The program `espalier`: lattices, deformation and pictures from the command line.

#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "tools/command_line.h"

int main(int argc, char** argv) {
  try {
    const auto status =
        espalier::tools::run_command_line(std::vector<std::string>(argv + 1, argv + argc));
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) {
      return static_cast<int>(status);
    }
    std::fputs("espalier: cannot write to standard output\n", stderr);
  } catch (const std::bad_alloc&) {
    std::fputs("espalier: not enough memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "espalier: %s\n", error.what());
  }
  return static_cast<int>(espalier::tools::ExitStatus::Failed);
}
