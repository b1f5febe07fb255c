// Trajectory files: any text gives rows or a refusal that names the place, nothing else.
#include <stdexcept>

#include "config/error.hpp"
#include "io/error.hpp"
#include "io/trajectory_reader.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace inslab;
  const fuzz::MemoryFile file(data, size, "fuzz.nav");
  try {
    io::read_trajectory(file.path());
  } catch (const io::ReadError&) {
  }
  return 0;
}
