#include "inslab/bus/service/scenario_hash.hpp"

#include "inslab/data/json/json_writer.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/foundation/files/sha256.hpp"

namespace inslab::service {

namespace {

template <class Profile>
void add_profile(files::Sha256& hash, const Profile& profile) {
  std::vector<std::uint8_t> cdr;
  wire::encode(profile, cdr);
  hash.add_text({cdr.begin(), cdr.end()});
}

}  // namespace

std::string scenario_hash(const scenario::LoadedScenario& loaded) {
  files::Sha256 hash;
  hash.add_text(json::json_from_struct(loaded.scenario).dump());
  for_each_sensor(loaded, [&hash](auto kind, const auto& sensor) {
    for_each_profile(kind, sensor, [&hash](const auto& profile) { add_profile(hash, profile); });
    add_profile(hash, sensor.nominal_installation);
  });
  for (const catalog::AnyProfile& swap : loaded.swaps) {
    std::visit([&hash](const auto& profile) { add_profile(hash, profile); }, swap);
  }
  const scenario::Trajectory& trajectory = loaded.scenario.trajectory;
  if (trajectory.source == scenario::TrajectorySource::File) {
    hash.add_file((loaded.file.parent_path() / trajectory.file.path).string());
  }
  if (!trajectory.gravity.grid_file.empty()) {
    hash.add_file((loaded.file.parent_path() / trajectory.gravity.grid_file).string());
  }
  return hash.hexadecimal();
}

}  // namespace inslab::service
