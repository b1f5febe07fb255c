#include "inslab/services/inslab/derived/derived_files.hpp"

#include "inslab/data/json/reference_writer.hpp"
#include "inslab/data/json/schema_writer.hpp"
#include "inslab/data/wire/idl_writer.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::cli {

namespace {

template <class T>
DerivedFile schema_file(const std::string& name, const std::string& title) {
  return {"config/schema/" + name + ".schema.json", [title] { return config::schema<T>(title).dump(2) + "\n"; }};
}

std::string parameters_page() {
  std::string page =
      "# Every key of the JSON files\n\n"
      "Derived from the declarations in `common/scenario`, `common/data/profiles` and `common/models/navigation` by "
      "`inslab reference docs/parameters.md`; a key carries its unit. Where a list of 3 is expected, one number stands "
      "for all axes.\n";
  const auto add = [&page](const std::string& title, const std::string& table) {
    page += "\n## " + title + "\n\n" + table;
  };
  add("Scenario (`config/scenarios`)", config::reference_table<scenario::Scenario>());
  add("IMU errors (`config/profiles/imu`)", config::reference_table<ImuErrorProfile>());
  add("Vibration (`config/profiles/vibration`)", config::reference_table<VibrationProfile>());
  add("Installation (`config/profiles/installation`)", config::reference_table<InstallationProfile>());
  add("GNSS errors (`config/profiles/gnss`)", config::reference_table<GnssErrorProfile>());
  add("Fault (`config/profiles/fault`)", config::reference_table<FaultProfile>());
  add("Navigation filter (`config/nav`)", config::reference_table<reference_nav::NavigationParameters>());
  return page;
}

}  // namespace

const std::vector<DerivedFile>& derived_files() {
  static const std::vector<DerivedFile> files{
      schema_file<scenario::Scenario>("scenario", "Inslab scenario"),
      schema_file<ImuErrorProfile>("imu_error", "Inslab IMU error profile"),
      schema_file<VibrationProfile>("vibration", "Inslab vibration profile"),
      schema_file<InstallationProfile>("installation", "Inslab installation profile"),
      schema_file<GnssErrorProfile>("gnss_error", "Inslab GNSS error profile"),
      schema_file<FaultProfile>("fault", "Inslab fault profile"),
      schema_file<reference_nav::NavigationParameters>("navigation", "Inslab navigation filter"),
      {"idl/profile.idl", wire::profile_idl},
      {"docs/parameters.md", parameters_page},
  };
  return files;
}

}  // namespace inslab::cli
