#pragma once

#include <sys/types.h>

#include <mutex>
#include <string>

namespace inslab::files {

/// What this process would leave behind if it ended now: results that are not whole, files for gnuplot, and gnuplot.
/// discard_unfinished() takes all of it away.

/// A file that is of no use to anybody until it is forgotten here: it is whole and has another name, or is gone.
void note_unfinished(const std::string& path);
void forget_unfinished(const std::string& path);

/// The same for as long as the object lives. Or a folder made for results, which goes when it is empty.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

 private:
  std::string path_;
};

/// Waits for a program of our own to end, which discard_unfinished() ends; returns its wait status, or -1 with errno.
int wait_for_program(pid_t program);

/// While it is held nothing is discarded: several files get their names together, or none does.
std::unique_lock<std::recursive_mutex> hold_unfinished();

/// Removes the files and ends the programs. Called when the process ends at once: whoever would begin, finish or name
/// another file waits from here on, for ever.
void discard_unfinished();

}  // namespace inslab::files
