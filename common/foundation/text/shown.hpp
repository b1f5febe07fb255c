#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace inslab::text {

/// Text of others as a terminal, a report or a log may have it: in any script, but with control characters and what
/// turns the direction of writing shown by their number ("\x1b", "\u202e"), and bytes that are not UTF-8 by theirs.
/// Line ends and tabs are control characters too.
std::string shown(std::string_view text);

/// The same with line ends and tabs left as they are: for texts of several lines.
std::string shown_lines(std::string_view text);

/// 'text' as shown(), cut after `most` characters: for a value that a message names.
std::string quoted(std::string_view text, std::size_t most = 60);

/// The beginning of a text, at most so many bytes, not cut within a character.
std::string cut(std::string_view text, std::size_t most_bytes);

/// A name as part of a file's name: what a file system, a shell or a web page might take for something else is '_'.
/// Letters of every script stay.
std::string file_name_of(std::string_view name);

/// Whether the text is UTF-8 without anything that shown() would change.
bool is_plain(std::string_view text);

}  // namespace inslab::text
