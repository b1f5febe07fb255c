#include "inslab/foundation/files/sha256.hpp"

#include <openssl/evp.h>

#include <cstdint>
#include <fstream>
#include <vector>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::files {

struct Sha256::Context {
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> evp{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  EVP_DigestInit_ex(context_->evp.get(), EVP_sha256(), nullptr);
}

Sha256::~Sha256() = default;

void Sha256::add(const void* data, std::size_t size) { EVP_DigestUpdate(context_->evp.get(), data, size); }

void Sha256::add_text(const std::string& text) {
  const std::uint64_t size = text.size();
  add(&size, sizeof(size));
  add(text.data(), text.size());
}

void Sha256::add_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 20);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
    add(piece.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) throw ReadError(path + ": cannot be read");
}

std::string Sha256::hexadecimal() {
  static constexpr char kHex[] = "0123456789abcdef";
  std::uint8_t digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  EVP_DigestFinal_ex(context_->evp.get(), digest, &size);
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += kHex[digest[i] >> 4];
    text += kHex[digest[i] & 15];
  }
  return text;
}

std::string sha256_of_file(const std::string& path) {
  Sha256 hash;
  hash.add_file(path);
  return hash.hexadecimal();
}

}  // namespace inslab::files
