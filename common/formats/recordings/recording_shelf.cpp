#include "inslab/formats/recordings/recording_shelf.hpp"

#include "inslab/formats/recordings/fix_errors_text.hpp"
#include "inslab/formats/recordings/recorded_errors_file.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/sha256.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::recordings {

namespace {

/// What is read under a hash, now or before; nothing is kept of what cannot be read.
template <class Recording, class Read>
std::shared_ptr<const Recording> kept(std::map<std::string, std::shared_ptr<const Recording>>& known,
                                      const std::string& sha256, const Read& read) {
  if (const auto found = known.find(sha256); found != known.end()) return found->second;
  return known[sha256] = std::make_shared<const Recording>(read());
}

}  // namespace

std::shared_ptr<const RecordedErrors> RecordingShelf::find_imu(const std::string& file, const std::string& sha256) {
  return kept(imus_, sha256, [&] { return read_recorded_errors(checked_path(file, sha256)).errors; });
}

std::shared_ptr<const RecordedFixErrors> RecordingShelf::find_fixes(const std::string& file,
                                                                    const std::string& sha256) {
  return kept(fixes_, sha256, [&] { return read_fix_errors(checked_path(file, sha256)); });
}

std::string RecordingShelf::checked_path(const std::string& file, const std::string& sha256) const {
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
  return path.string();
}

}  // namespace inslab::recordings
