#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

namespace inslab::tables {

/// Closes an HDF5 object.
class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  ~Hdf5Handle() { close(); }

  /// Negative when it could not be closed.
  herr_t close() { return id_ < 0 ? 0 : closer_(std::exchange(id_, -1)); }

  hid_t get() const { return id_; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

/// Throws WriteError with the library's innermost reason.
[[noreturn]] void throw_hdf5_error(const std::string& path, const std::string& action);

/// `result` when it is not negative.
template <class Result>
Result checked(Result result, const std::string& path, const std::string& action) {
  if (result < 0) throw_hdf5_error(path, action);
  return result;
}

}  // namespace inslab::tables
