#pragma once

#include <string>
#include <string_view>

namespace inslab::wire {

/// The product's own text of one file of idl/, with the files it includes put before it and no preprocessor line left:
/// what a reader needs to decode the types in it. Throws std::out_of_range for a name that is not in idl/.
std::string self_contained_idl(std::string_view idl_file);

/// The present name of a type that a log may call by an earlier one; any other name as it is. Before the types had a
/// version, version 1 was `inslab::TruthState` and so on.
std::string present_name(std::string_view type);

}  // namespace inslab::wire
