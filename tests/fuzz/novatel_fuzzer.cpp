// NovAtel logs: any text gives samples, lines that are counted as bad, or a refusal that names the place.
#include <cstdlib>

#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace inslab;
  const fuzz::MemoryFile file(data, size, "fuzz.asc");
  try {
    novatel::NovatelImuReader reader(file.path());
    novatel::NovatelImuRecord record;
    while (reader.next(record)) {
      if (!record.dtheta_b.allFinite() || !record.dv_b.allFinite()) std::abort();  // a good line has numbers
    }
  } catch (const files::ReadError&) {
  }
  return 0;
}
