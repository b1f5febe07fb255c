#include "inslab/formats/recordings/recording_shelf.hpp"

#include "inslab/formats/recordings/recorded_errors_file.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/sha256.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::recordings {

std::shared_ptr<const RecordedErrors> RecordingShelf::find(const std::string& file, const std::string& sha256) {
  if (const auto known = read_.find(sha256); known != read_.end()) return known->second;
  const std::filesystem::path name(file);
  if (file.empty() || name.filename() != name || file == "." || file == "..") {
    throw files::ReadError(text::quoted(file) + ": is a path; expected the name of a file in the folder of recordings");
  }
  const std::filesystem::path path = (folder_ / name).lexically_normal();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw files::ReadError(std::filesystem::absolute(path, error).string() +
                           ": is not there; recordings are looked for in that folder on each host");
  }
  if (const std::string is = files::sha256_of_file(path.string()); is != sha256) {
    throw files::ReadError(path.string() + ": has the SHA-256 " + is + "; the profile names " + sha256);
  }
  auto recording = std::make_shared<const RecordedErrors>(read_recorded_errors(path.string()).errors);
  read_[sha256] = recording;
  return recording;
}

}  // namespace inslab::recordings
