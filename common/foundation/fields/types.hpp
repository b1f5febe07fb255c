#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace inslab {

/// A list of types that code is made for, one after the other.
template <class... T>
struct Types {
  static constexpr std::size_t size = sizeof...(T);
};

/// Stands for a type where a value is needed: `typename decltype(tag)::type`.
template <class T>
struct Tag {
  using type = T;
};

/// Calls `visit` with a Tag of each type, in their order.
template <class... T, class Visit>
constexpr void for_each(Types<T...>, const Visit& visit) {
  (visit(Tag<T>{}), ...);
}

/// Calls `visit` with each element of a tuple, in their order.
template <class Tuple, class Visit>
constexpr void for_each_of(Tuple&& tuple, const Visit& visit) {
  std::apply([&visit](auto&&... element) { (visit(element), ...); }, tuple);
}

namespace detail {
template <template <class...> class Of, class List>
struct Applied;
template <template <class...> class Of, class... T>
struct Applied<Of, Types<T...>> {
  using type = Of<T...>;
};
template <template <class> class Of, class List>
struct Mapped;
template <template <class> class Of, class... T>
struct Mapped<Of, Types<T...>> {
  using type = Types<Of<T>...>;
};
template <class... List>
struct Joined {
  using type = Types<>;
};
template <class... A>
struct Joined<Types<A...>> {
  using type = Types<A...>;
};
template <class... A, class... B, class... More>
struct Joined<Types<A...>, Types<B...>, More...> {
  using type = typename Joined<Types<A..., B...>, More...>::type;
};
template <class T, class List>
struct IsAmong;
template <class T, class... One>
struct IsAmong<T, Types<One...>> : std::bool_constant<(std::is_same_v<T, One> || ...)> {};
}  // namespace detail

/// Of<T...>, as in Applied<std::variant, List>.
template <template <class...> class Of, class List>
using Applied = typename detail::Applied<Of, List>::type;

/// Types<Of<T>...>.
template <template <class> class Of, class List>
using Mapped = typename detail::Mapped<Of, List>::type;

/// One list of several.
template <class... List>
using Joined = typename detail::Joined<List...>::type;

template <class T, class List>
inline constexpr bool is_among = detail::IsAmong<T, List>::value;

}  // namespace inslab
