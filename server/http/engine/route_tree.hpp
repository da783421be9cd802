#pragma once

#include "http/route.hpp"

namespace fitgauge::http {

inline constexpr std::size_t kMaxSegments = 16;

/// A request's path, split at its slashes and then decoded.
class PathSegments {
 public:
  std::size_t count() const { return count_; }  ///< at most kMaxSegments
  /// There are more, which only a `{rest*}` reaches.
  bool is_longer() const { return is_longer_; }

  std::string_view segment(std::size_t index) const {
    return {path_.data() + begins_[index], begins_[index + 1] - begins_[index] - 1};
  }
  /// Everything from segment `index` on.
  std::string_view rest(std::size_t index) const {
    return {path_.data() + begins_[index], path_.size() - begins_[index]};
  }

 private:
  friend bool split_path(std::string_view path, std::string& decoded, PathSegments& out);

  /// A segment has ended; the next one would begin at `begin`.
  void end_segment(std::size_t begin) {
    if (count_ == kMaxSegments) {
      is_longer_ = true;
    } else {
      begins_[++count_] = static_cast<std::uint32_t>(begin);
    }
  }

  std::string_view path_;  ///< after its first slash, decoded
  std::array<std::uint32_t, kMaxSegments + 1> begins_{};
  std::size_t count_ = 0;
  bool is_longer_ = false;
};

/// @param decoded receives the path if it differs from the sent one; its capacity must have room
/// for path.size() more bytes, so that it does not move. `out` views it or `path`.
/// @returns false if the path does not begin with a slash or cannot be decoded.
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

/// The routes as a tree of path segments; a literal goes before a parameter, a parameter before a
/// rest. Immutable after construction.
class RouteTree {
 public:
  /// Additional facts of a route for dispatch.
  struct Plan {
    struct Capture {
      std::size_t parameter = 0;
      std::size_t segment = 0;
      bool takes_rest = false;
    };
    std::vector<Capture> captures;  ///< in pattern order
    bool has_query = false;
    bool has_headers = false;
  };

  /// Adds the path parameters that `routes` leave out.
  explicit RouteTree(std::vector<Route>& routes);

  /// The resource at a path, or null.
  const Resource* find(const PathSegments& path) const { return descend(root_, path, 0); }
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
  static const Resource* descend(const Node& node, const PathSegments& path, std::size_t depth);

  Node root_;
  std::vector<Plan> plans_;
};

/// Reads the decoded text of a parameter as its type; the value may view `text`.
/// @errors PathMalformed, QueryInvalid or RequestMalformed by the parameter's place, with its name
///   and accepted values; LengthMalformed, LengthTooFine, LengthOutOfRange for lengths.
Result<ArgumentValue> parse_argument(const Parameter& parameter, std::string_view text);

}  // namespace fitgauge::http
