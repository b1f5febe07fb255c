#include "inslab/foundation/files/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::files {

OutputFile::OutputFile(const std::string& path, Kind kind) : path_(path) {
  if (kind == Kind::Result) {
    place_.emplace(path);
  } else {
    check_output(path);
  }
  const std::string& file = place_ ? place_->growing() : path_;
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw WriteError(path_, "create", errno);
  claim();
  if (::ftruncate(descriptor_, 0) == 0 || errno == EINVAL) return;  // pipes and devices have no length
  const int error_number = errno;
  ::close(descriptor_);
  throw WriteError(path_, "empty", error_number);
}

OutputFile::OutputFile(const std::string& path, std::uint64_t keep) : path_(path), size_(keep) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw WriteError(path_, "open", errno);
  claim();
  const auto end = static_cast<off_t>(keep);
  if (::ftruncate(descriptor_, end) == 0 && ::lseek(descriptor_, end, SEEK_SET) == end) return;
  const int error_number = errno;
  ::close(descriptor_);
  throw WriteError(path_, "cut", error_number);
}

/// For as long as this process writes to the file nobody else does. File systems that know no locks do without.
void OutputFile::claim() {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(std::exchange(descriptor_, -1));
  throw OutputRefused(being_written(path_));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::append(const std::uint8_t* data, std::size_t size) {
  // write() moves at most 2 GiB at once.
  constexpr std::size_t kPiece = std::size_t{1} << 30;
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::write(descriptor_, data + done, std::min(kPiece, size - done));
    if (count > 0) {
      done += static_cast<std::size_t>(count);
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    const int error_number = count == 0 ? ENOSPC : errno;
    if (done > 0 && ::ftruncate(descriptor_, static_cast<off_t>(size_)) == 0) {
      ::lseek(descriptor_, static_cast<off_t>(size_), SEEK_SET);
    }
    throw WriteError(path_, "write", error_number);
  }
  size_ += size;
}

void OutputFile::close() {
  if (descriptor_ < 0) return;
  // Errors of a delayed write show here. Pipes and devices cannot be synchronised and say EINVAL.
  const bool synced = ::fsync(descriptor_) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
  const int sync_error = errno;
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (!synced) throw WriteError(path_, "write to the disk", sync_error);
  if (closed != 0 && errno != EINTR) throw WriteError(path_, "close", errno);
  if (place_) place_->commit();
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.append(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  file.close();
}

}  // namespace inslab::files
