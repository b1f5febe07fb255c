#include "inslab/sim/navigation_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/formats/rinex/rinex_navigation.hpp"
#include "inslab/models/satellites/stray_records.hpp"

namespace inslab::sim {

namespace {

/// Records of one kind out of all files, with the place that each has.
template <class Ephemeris>
class Gathered {
 public:
  void add(const std::string& path, const std::vector<rinex::NavigationRecord<Ephemeris>>& records) {
    for (const auto& [ephemeris, line] : records) {
      ephemerides_.push_back(ephemeris);
      places_.push_back(fmt::format("{}: line {}", path, line));
    }
  }

  /// Those that agree with a neighbour; the others are told in `refused`.
  std::vector<Ephemeris> believed(std::vector<std::string>& refused) const {
    std::vector<bool> is_stray(ephemerides_.size(), false);
    for (const satellites::StrayRecord& stray : satellites::stray_records(ephemerides_)) {
      is_stray[stray.index] = true;
      refused.push_back(fmt::format("{}: {} is {:.1f} km from where its neighbours put it", places_[stray.index],
                                    name_of(ephemerides_[stray.index].satellite), stray.off_m / 1000.0));
    }
    std::vector<Ephemeris> kept;
    for (std::size_t i = 0; i < ephemerides_.size(); ++i) {
      if (!is_stray[i]) kept.push_back(ephemerides_[i]);
    }
    return kept;
  }

 private:
  std::vector<Ephemeris> ephemerides_;
  std::vector<std::string> places_;
};

}  // namespace

NavigationFiles load_navigation_files(const std::vector<std::string>& paths) {
  NavigationFiles all;
  Gathered<KeplerianEphemeris> keplerian;
  Gathered<GlonassEphemeris> glonass;
  for (const std::string& path : paths) {
    const rinex::NavigationFile file = rinex::read_navigation(path);
    keplerian.add(path, file.keplerian);
    glonass.add(path, file.glonass);
    for (const BroadcastIonosphere& ionosphere : file.ionosphere) {
      const bool is_known = std::any_of(all.ionosphere.begin(), all.ionosphere.end(),
                                        [&](const auto& known) { return known.system == ionosphere.system; });
      if (!is_known) all.ionosphere.push_back(ionosphere);
    }
  }
  all.keplerian = keplerian.believed(all.refused);
  all.glonass = glonass.believed(all.refused);
  return all;
}

}  // namespace inslab::sim
