#include <system_error>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::files {

WriteError::WriteError(const std::string& path, const std::string& action, int error_number)
    : std::runtime_error(path + ": cannot " + action + ": " + std::generic_category().message(error_number)) {}

}  // namespace inslab::files
