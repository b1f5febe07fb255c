#pragma once

/// Says to the compiler that libfmt has the function with which spdlog formats a message. Without it every source that
/// logs compiles all of fmt's number formatting once more: three to four seconds and 80 kB each.

#include <fmt/format.h>

#ifndef FMT_HEADER_ONLY
FMT_BEGIN_NAMESPACE
namespace detail {
#if FMT_VERSION < 100000
extern template void vformat_to<char>(buffer<char>& buf, basic_string_view<char> fmt,
                                      basic_format_args<FMT_BUFFER_CONTEXT(type_identity_t<char>)> args,
                                      locale_ref loc);
#elif FMT_VERSION < 110000
extern template void vformat_to<char>(buffer<char>& buf, basic_string_view<char> fmt, vformat_args<char>::type args,
                                      locale_ref loc);
#endif
}  // namespace detail
FMT_END_NAMESPACE
#endif
