// Scenario and profile files: any text gives a value or a json::Error, nothing else.
#include <string>

#include "inslab/data/json/config_error.hpp"
#include "inslab/scenario/load.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace inslab;
  if (size == 0) return 0;
  const fuzz::MemoryFile file(data + 1, size - 1, "fuzz.json");
  constexpr SensorAddress kImu{SensorKind::Imu, 0};
  constexpr SensorAddress kGnss{SensorKind::Gnss, 0};
  try {
    switch (data[0] % 6) {
      case 0:
        scenario::load(file.path());
        break;
      case 1:
        scenario::load_profile(file.path(), ProfileKind::ImuError, kImu);
        break;
      case 2:
        scenario::load_profile(file.path(), ProfileKind::Vibration, kImu);
        break;
      case 3:
        scenario::load_profile(file.path(), ProfileKind::Installation, kGnss);
        break;
      case 4:
        scenario::load_profile(file.path(), ProfileKind::GnssError, kGnss);
        break;
      case 5:
        scenario::load_profile(file.path(), ProfileKind::Fault, kImu);
        break;
    }
  } catch (const json::Error&) {
  }
  return 0;
}
