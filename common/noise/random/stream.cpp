#include "inslab/noise/random/stream.hpp"

#include "inslab/noise/random/box_muller.hpp"

namespace inslab::random {
namespace {

constexpr std::uint64_t kFnvOffset = 0xCBF29CE484222325;
constexpr std::uint64_t kFnvPrime = 0x100000001B3;

/// Fowler, Noll, Vo: FNV-1a, continued from `hash`; a child's hash is that of the joined name.
std::uint64_t extended(std::uint64_t hash, std::string_view text) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * kFnvPrime;
  return hash;
}

constexpr std::uint64_t kBlocks = Stream::kGroup / 2;  // a block of 128 bits makes two numbers
constexpr int kLanePairs = static_cast<int>(kBlocks / 2);

}  // namespace

Stream::Stream(std::uint64_t seed, std::string_view name) : seed_(seed), name_hash_(extended(kFnvOffset, name)) {}

Stream Stream::child(std::string_view suffix) const {
  Stream stream = *this;
  stream.name_hash_ = extended(name_hash_, suffix);
  return stream;
}

Stream::Group Stream::normal_group(std::uint64_t group) const {
  const auto bits = philox<kLanePairs>(seed_, group * kBlocks, name_hash_);
  Group numbers;
#pragma GCC unroll 4
  for (int i = 0; i < kLanePairs; ++i) {
    const auto [cosine, sine] = normals_from_bits(bits[i]);
    numbers[4 * i] = cosine[0];
    numbers[4 * i + 1] = sine[0];
    numbers[4 * i + 2] = cosine[1];
    numbers[4 * i + 3] = sine[1];
  }
  return numbers;
}

Stream::Group Stream::uniform_group(std::uint64_t group) const {
  const auto bits = philox<kLanePairs>(seed_, group * kBlocks, name_hash_);
  Group numbers;
  for (int i = 0; i < kLanePairs; ++i) {
    const Doubles first = uniform_from_bits(bits[i].first);
    const Doubles second = uniform_from_bits(bits[i].second);
    numbers[4 * i] = first[0];
    numbers[4 * i + 1] = second[0];
    numbers[4 * i + 2] = first[1];
    numbers[4 * i + 3] = second[1];
  }
  return numbers;
}

std::uint64_t seed_of(std::uint64_t seed, std::string_view name) {
  return philox<1>(seed, 0, extended(kFnvOffset, name))[0].first[0];
}

}  // namespace inslab::random
