#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::reference_nav {

/// The services whose samples an IMU sample may have to wait for, and up to which sim time each has sent all: the
/// receiver's, and those of the other sensors that the app takes.
class Sources {
 public:
  static constexpr std::int64_t kEver = std::numeric_limits<std::int64_t>::max();

  explicit Sources(const scenario::ReferenceNav& app) {
    complete_up_to_ns_[{catalog::Gnss::service, app.gnss}] = kEver;
    for_each(scenario::AidKinds{}, [&](auto tag) {
      using Kind = typename decltype(tag)::type;
      scenario::for_each_of_the_app<Kind>(app, [this](std::string_view, std::uint32_t number) {
        complete_up_to_ns_[{Kind::service, number}] = kEver;
      });
    });
  }

  /// Which they are never changes, so this may be asked in any thread.
  bool has(const std::string& service, std::uint32_t number) const {
    return complete_up_to_ns_.count({service, number}) > 0;
  }

  void all_complete_up_to(std::int64_t sim_time_ns) {
    for (auto& each : complete_up_to_ns_) each.second = sim_time_ns;
  }
  void complete_up_to(const std::string& service, std::uint32_t number, std::int64_t sim_time_ns) {
    const auto source = complete_up_to_ns_.find({service, number});
    if (source != complete_up_to_ns_.end()) source->second = sim_time_ns;
  }

  /// Everything that is available at or before this sim time has come.
  std::int64_t complete_up_to() const {
    std::int64_t earliest_ns = kEver;
    for (const auto& each : complete_up_to_ns_) earliest_ns = std::min(earliest_ns, each.second);
    return earliest_ns;
  }

 private:
  std::map<scenario::ServiceKey, std::int64_t> complete_up_to_ns_;
};

}  // namespace inslab::reference_nav
