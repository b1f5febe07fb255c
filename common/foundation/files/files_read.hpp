#pragma once

#include <string>
#include <vector>

namespace inslab::files {

/// The files that this process has read, known by what they are and not by how they were spelt: no output may replace
/// one of them. Every reader notes what it opens; a file of the same device and inode counts as read, be it named by a
/// link or by another path.
void note_file_read(const std::string& path);
bool is_file_read(const std::string& path);

/// The same files as they were spelt when they were opened, in order; each spelling once.
std::vector<std::string> files_read();

}  // namespace inslab::files
