#pragma once

#include <string>

namespace inslab::config {

/// The files that this process has read, known by what they are and not by how they were spelt: no output may replace
/// one of them. Every reader notes what it opens; a file of the same device and inode counts as read, be it named by a
/// link or by another path.
void note_file_read(const std::string& path);
bool is_file_read(const std::string& path);

}  // namespace inslab::config
