#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"

namespace inslab::log {

/// One reading of a log, for several who each want some of its samples.
///
/// Whoever wants the samples of a type asks for them with each(); go() then reads the log once, in the order in which
/// it was written, and gives each sample to those who asked, in the order in which they did. A message is decoded once,
/// and only when somebody asked; one that is not what its type says is left out.
class LogWalk {
 public:
  /// Where a sample stands in the log.
  struct Place {
    const std::string& topic;
    std::int64_t log_time_ns;  ///< of a live run: CLOCK_REALTIME of its reception
  };

  /// `log` is used until the end of go().
  explicit LogWalk(const mcap::McapReader& log) : log_(log) {}

  /// `take(sample)` or `take(sample, place)` is called with each sample of the type T.
  template <class T, class Take>
  void each(Take take) {
    std::unique_ptr<Takers>& takers = by_type_[std::string(catalog::WireType<T>::name)];
    if (!takers) takers = std::make_unique<TakersOf<T>>();
    auto& all = static_cast<TakersOf<T>&>(*takers).all;
    if constexpr (std::is_invocable_v<Take, const T&, const Place&>) {
      all.push_back(std::move(take));
    } else {
      all.push_back([take = std::move(take)](const T& sample, const Place&) { take(sample); });
    }
  }

  /// `take()` is called for each message of the topic, also for one that does not decode.
  void each_message(const std::string& topic, std::function<void()> take) { by_topic_.emplace(topic, std::move(take)); }

  /// Throws ReadError, and what those who take throw.
  void go() const;

 private:
  struct Takers {
    Takers() = default;
    virtual ~Takers() = default;
    Takers(const Takers&) = delete;
    Takers& operator=(const Takers&) = delete;
    virtual void give(const mcap::Message& message, const Place& place) const = 0;
  };
  template <class T>
  struct TakersOf final : Takers {
    void give(const mcap::Message& message, const Place& place) const override {
      T sample;
      if (!wire::decode(message.data, message.size, sample)) return;
      for (const auto& take : all) take(sample, place);
    }
    std::vector<std::function<void(const T&, const Place&)>> all;
  };

  const mcap::McapReader& log_;
  std::map<std::string, std::unique_ptr<Takers>> by_type_;
  std::multimap<std::string, std::function<void()>> by_topic_;
};

}  // namespace inslab::log
