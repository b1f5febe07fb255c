#include "inslab/bus/service/scenario_hash.hpp"

#include <openssl/evp.h>

#include <fstream>
#include <memory>

#include "inslab/data/json/json_writer.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/foundation/files/file_error.hpp"

namespace inslab::service {

namespace {

class Sha256 {
 public:
  Sha256() { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }

  void add(const void* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }
  /// With its length, so that what follows cannot be taken for a part of it.
  void add_text(const std::string& text) {
    const std::uint64_t size = text.size();
    add(&size, sizeof(size));
    add(text.data(), text.size());
  }
  template <class Profile>
  void add_profile(const Profile& profile) {
    wire::encode(profile, cdr_);
    add_text({cdr_.begin(), cdr_.end()});
  }

  std::string hexadecimal() {
    static constexpr char kHex[] = "0123456789abcdef";
    std::uint8_t digest[EVP_MAX_MD_SIZE];
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest, &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += kHex[digest[i] >> 4];
      text += kHex[digest[i] & 15];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
  std::vector<std::uint8_t> cdr_;
};

void add_file(Sha256& hash, const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 20);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
    hash.add(piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) throw files::ReadError(path.string() + ": cannot be read");
}

}  // namespace

std::string scenario_hash(const scenario::LoadedScenario& loaded) {
  Sha256 hash;
  hash.add_text(json::json_from_struct(loaded.scenario).dump());
  for_each_sensor(loaded, [&hash](auto kind, const auto& sensor) {
    for_each_profile(kind, sensor, [&hash](const auto& profile) { hash.add_profile(profile); });
    hash.add_profile(sensor.nominal_installation);
  });
  for (const catalog::AnyProfile& swap : loaded.swaps) {
    std::visit([&hash](const auto& profile) { hash.add_profile(profile); }, swap);
  }
  const scenario::Trajectory& trajectory = loaded.scenario.trajectory;
  if (trajectory.source == scenario::TrajectorySource::File) {
    add_file(hash, loaded.file.parent_path() / trajectory.file.path);
  }
  if (!trajectory.gravity.grid_file.empty()) {
    add_file(hash, loaded.file.parent_path() / trajectory.gravity.grid_file);
  }
  return hash.hexadecimal();
}

}  // namespace inslab::service
