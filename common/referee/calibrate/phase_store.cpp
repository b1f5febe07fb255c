#include "inslab/referee/calibrate/phase_store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::calibrate {
namespace {

constexpr std::size_t kHeld = std::size_t{1} << 22;

/// TMPDIR, or what the system has for it.
std::string folder() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::temp_directory_path(error);
  if (!error) return path.string();
  const char* wanted = std::getenv("TMPDIR");
  throw files::WriteError(wanted == nullptr ? "/tmp" : wanted, "a folder for temporary files (TMPDIR)", error.value());
}

/// A file without a name; null, and errno, when there can be none.
std::FILE* nameless_file(const std::string& folder) {
  std::string name = folder + "/inslab-allan-XXXXXX";
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  unlink(name.c_str());
  std::FILE* file = fdopen(descriptor, "w+b");
  if (file == nullptr) close(descriptor);
  return file;
}

}  // namespace

void PhaseStore::add(double increment) {
  if (samples_++ == 0) first_ = increment;
  phase_ += increment - first_;
  put(phase_);
}

void PhaseStore::put(double phase) {
  held_.push_back(phase);
  if (held_.size() < kHeld) return;
  if (!file_) file_.reset(nameless_file(folder()));
  if (!file_ || std::fwrite(held_.data(), sizeof(double), held_.size(), file_.get()) != held_.size()) {
    const int error = errno;
    throw files::WriteError(folder(),
                            "room for the integrals of an Allan curve, 8 bytes a sample and axis; TMPDIR names another "
                            "folder",
                            error);
  }
  in_file_ += held_.size();
  held_.clear();
}

std::vector<double> PhaseStore::phase() const {
  std::vector<double> all(in_file_ + held_.size());
  if (file_) {
    std::rewind(file_.get());
    if (std::fread(all.data(), sizeof(double), in_file_, file_.get()) != in_file_ ||
        std::fseek(file_.get(), 0, SEEK_END) != 0) {
      throw files::ReadError("temporary file of the Allan curve: cannot be read back");
    }
  }
  std::copy(held_.begin(), held_.end(), all.begin() + static_cast<std::ptrdiff_t>(in_file_));
  return all;
}

}  // namespace inslab::calibrate
