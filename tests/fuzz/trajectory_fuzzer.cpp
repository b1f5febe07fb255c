// Trajectory files: any text gives rows or a refusal that names the place, nothing else.
#include <stdexcept>

#include "inslab/data/json/config_error.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace inslab;
  const fuzz::MemoryFile file(data, size, "fuzz.nav");
  try {
    trajectory::read_trajectory(file.path());
  } catch (const files::ReadError&) {
  }
  return 0;
}
