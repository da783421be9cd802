#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "http/route.hpp"

namespace fitgauge::http {

inline constexpr std::size_t kMaxSegments = 16;

/// A request's path, split at its slashes and then decoded.
struct PathSegments {
  std::array<std::string_view, kMaxSegments> segments{};
  std::size_t count = 0;      ///< at most kMaxSegments
  bool longer = false;        ///< there are more, which only a `{rest*}` reaches
  const char* end = nullptr;  ///< of the decoded path

  /// Everything from segment `index` on.
  std::string_view rest(std::size_t index) const {
    return {segments[index].data(), static_cast<std::size_t>(end - segments[index].data())};
  }
};

/// @param decoded receives the path where it differs from what was sent; its capacity must hold
///   path.size() more bytes, so that it does not move. `out` views it or `path`.
/// @returns false for a path that does not begin with a slash or cannot be decoded.
bool split_path(std::string_view path, std::string& decoded, PathSegments& out);

/// The operations on one path shape.
struct Resource {
  static constexpr std::int16_t kNone = -1;

  std::array<std::int16_t, 7> routes{kNone, kNone, kNone, kNone, kNone, kNone, kNone};

  /// The index of the route for a method, GET's for HEAD, or kNone.
  std::int16_t route(Method method) const;
  /// `GET, HEAD, OPTIONS`
  std::string allow() const;
};

struct RouteMatch {
  const Resource* resource = nullptr;
  std::array<std::string_view, kMaxSegments> captures{};
  std::size_t capture_count = 0;
};

/// The routes as a tree of path segments; a literal goes before a parameter, a parameter before a
/// rest. Immutable after construction.
class RouteTree {
 public:
  /// What dispatch needs to know of a route besides the route itself.
  struct Plan {
    std::vector<std::size_t> captured;  ///< path parameter of each capture, in pattern order
    bool has_query = false;
    bool has_headers = false;
  };

  /// Adds the path parameters that `routes` leave out.
  explicit RouteTree(std::vector<Route>& routes);

  RouteMatch find(const PathSegments& path) const;
  const Plan& plan(std::size_t route) const { return plans_[route]; }

 private:
  struct Node {
    std::vector<std::pair<std::string, std::unique_ptr<Node>>> literals;
    std::unique_ptr<Node> parameter;
    std::unique_ptr<Node> rest;
    Resource resource;
    bool is_resource = false;
  };

  void add(Route& route, std::int16_t index);
  static bool descend(const Node& node, const PathSegments& path, std::size_t depth,
                      RouteMatch& match);

  Node root_;
  std::vector<Plan> plans_;
};

}  // namespace fitgauge::http
