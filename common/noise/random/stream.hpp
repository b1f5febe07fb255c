#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace inslab::random {

/// Random numbers without a state: every draw is a pure function of (scenario seed, stream name, index).
///
/// The name says what the numbers are for, such as "imu0/gyro.x/arw"; another name is another stream, so no sensor,
/// axis or term shares numbers with another, and what one of them draws changes nothing for the rest. The generator is
/// Philox4x32-10; its key is the seed, its counter (index / 2, 64-bit FNV-1a hash of the name). Uniform and normal
/// numbers of one stream come from the same bits: use one kind per stream.
class Stream {
 public:
  /// Numbers 8 k to 8 k + 7, which cost hardly more together than one of them alone.
  static constexpr std::uint64_t kGroup = 8;
  using Group = std::array<double, kGroup>;

  Stream(std::uint64_t seed, std::string_view name);

  /// The stream named `name + suffix`, such as the redraws of a process.
  Stream child(std::string_view suffix) const;

  /// Standard normal.
  double normal(std::uint64_t index) const { return normal_group(index / kGroup)[index % kGroup]; }

  /// Uniform on [0, 1), 52 bits.
  double uniform(std::uint64_t index) const { return uniform_group(index / kGroup)[index % kGroup]; }

  /// Numbers kGroup * group to kGroup * group + kGroup - 1.
  Group normal_group(std::uint64_t group) const;
  Group uniform_group(std::uint64_t group) const;

  friend bool operator==(const Stream& a, const Stream& b) {
    return a.seed_ == b.seed_ && a.name_hash_ == b.name_hash_;
  }
  friend bool operator!=(const Stream& a, const Stream& b) { return !(a == b); }

 private:
  std::uint64_t seed_;
  std::uint64_t name_hash_;
};

/// 64 bits drawn from (seed, name): the seed of what shares no stream with others of the same seed, such as a vehicle.
std::uint64_t seed_of(std::uint64_t seed, std::string_view name);

/// Reads the normal numbers of a stream; equal to Stream::normal at every index, and cheap for indices that follow each
/// other. What it keeps is a cache, not a state.
class NormalCursor {
 public:
  explicit NormalCursor(const Stream& stream) : stream_(stream) {}

  double at(std::uint64_t index) {
    const std::uint64_t group = index / Stream::kGroup;
    if (group != group_) {
      group_ = group;
      values_ = stream_.normal_group(group);
    }
    return values_[index % Stream::kGroup];
  }

 private:
  Stream stream_;
  std::uint64_t group_ = std::numeric_limits<std::uint64_t>::max();  // no index lies in this group
  Stream::Group values_{};
};

}  // namespace inslab::random
