#include "nc/machine/triangle_tree.hpp"

namespace fitgauge::machine {
namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of anything and the count
constexpr std::size_t kRecord = 50;  // normal and three corners as floats, two bytes of anything
constexpr double kFarthest = 1e7;

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

template <class... Parts>
Error refused(fmt::format_string<Parts...> message, Parts&&... parts) {
  return {ErrorCode::FieldInvalid, fmt::format(message, std::forward<Parts>(parts)...)};
}

std::string place_of(const Vec3& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }

bool is_near(const Vec3& p) {
  return std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
}

Result<std::vector<Triangle>> read_binary(std::string_view bytes) {
  const std::size_t count = (bytes.size() - kHeader) / kRecord;
  std::vector<Triangle> triangles(count);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 9> corners;
    std::memcpy(corners.data(), bytes.data() + kHeader + t * kRecord + 3 * sizeof(float),
                sizeof corners);
    for (std::size_t k = 0; k < 9; ++k) triangles[t][k / 3][k % 3] = double{corners[k]};
    if (std::ranges::all_of(triangles[t], is_near)) continue;
    return refused("triangle {} has a corner that is not a point", t + 1);
  }
  return triangles;
}

class TextReader {
 public:
  explicit TextReader(std::string_view text) : rest_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (!rest_.empty() && is_blank(rest_.front())) {
      line_ += rest_.front() == '\n';
      rest_.remove_prefix(1);
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_blank(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }

  Result<std::vector<Triangle>> read() {
    next();  // solid
    skip_line();
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (ascii_iequals(word, "solid") || ascii_iequals(word, "endsolid")) {
        skip_line();
        continue;
      }
      if (!ascii_iequals(word, "facet")) return expected("facet", word);
      TRY(facet());
    }
    return std::move(triangles_);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip_line() { rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size())); }

  Error expected(std::string_view what, std::string_view found) const {
    return refused("line {}: expected {}, found '{}'", line_, what,
                   found.empty() ? "the end of the file" : found.substr(0, 40));
  }

  Result<void> word(std::string_view lower) {
    const std::string_view found = next();
    if (!ascii_iequals(found, lower)) return expected(lower, found);
    return {};
  }

  Result<Vec3> numbers() {
    Vec3 values;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view found = next();
      const std::string_view digits = found.starts_with('+') ? found.substr(1) : found;
      const auto read = read_number<double>(digits);
      if (!read) return expected("a number", found);
      values[k] = *read;
    }
    return values;
  }

  Result<void> facet() {
    TRY(word("normal"));
    TRY(numbers());
    TRY(word("outer"));
    TRY(word("loop"));
    Triangle& triangle = triangles_.emplace_back();
    for (Vec3& corner : triangle) {
      TRY(word("vertex"));
      corner = TRY(numbers());
      if (!is_near(corner)) return refused("line {}: too far away", line_);
    }
    TRY(word("endloop"));
    return word("endfacet");
  }

  std::string_view rest_;
  std::size_t line_ = 1;
  std::vector<Triangle> triangles_;
};

/// A number for each corner, the same for corners at the same place.
std::vector<std::uint32_t> numbered(const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> order(3 * triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto at = [&](std::uint32_t k) -> const Vec3& { return triangles[k / 3][k % 3]; };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const Vec3& p = at(a);
    const Vec3& q = at(b);
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
  });
  std::vector<std::uint32_t> numbers(order.size());
  std::uint32_t number = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k > 0 && !(at(order[k]) == at(order[k - 1]))) ++number;
    numbers[order[k]] = number;
  }
  return numbers;
}

/// An edge of a triangle between two numbered corners.
struct Edge {
  std::uint64_t corners;  ///< the lesser number in the upper half
  std::uint32_t place;    ///< 3 times its triangle and the corner it leaves
  bool runs_up;           ///< from the lesser number to the greater
};

std::vector<Edge> edges_of(const std::vector<Triangle>& triangles) {
  const std::vector<std::uint32_t> numbers = numbered(triangles);
  std::vector<Edge> edges(numbers.size());
  for (std::uint32_t k = 0; k < edges.size(); ++k) {
    const std::uint32_t a = numbers[k];
    const std::uint32_t b = numbers[k - k % 3 + (k + 1) % 3];
    edges[k] = {std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), k, a < b};
  }
  std::ranges::sort(edges, {}, &Edge::corners);
  return edges;
}

}  // namespace

Result<std::vector<Triangle>> read_stl(std::string_view bytes) {
  if (bytes.size() >= kHeader) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
    if (bytes.size() == kHeader + kRecord * std::size_t{count}) return read_binary(bytes);
  }
  if (ascii_iequals(TextReader(bytes).next(), "solid")) return TextReader(bytes).read();
  return refused(
      "is not an STL file: a text begins with 'solid', a binary file has 84 bytes and 50 for each "
      "triangle that it counts");
}

Result<void> check_closed(const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return refused("has no triangle");
  const auto corner = [&](std::uint32_t place) {
    return place_of(triangles[place / 3][place % 3]);
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    constexpr double kFlat = 1e-14;  // of its sides: the cross product is rounding
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    if (norm(cross(b - a, c - a)) > kFlat * longest * longest) continue;
    return refused("is degenerate: triangle {} at {} has no area", t + 1, place_of(a));
  }
  const std::vector<Edge> edges = edges_of(triangles);
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(),
                                  [&](const Edge& e) { return e.corners != begin->corners; });
    const auto up = std::count_if(begin, end, [](const Edge& e) { return e.runs_up; });
    if (2 * up != end - begin) {
      const std::uint32_t place = begin->place;
      const std::string edge = fmt::format("the edge from {} to {}", corner(place),
                                           corner(place - place % 3 + (place + 1) % 3));
      if ((end - begin) % 2 == 1)
        return refused("is open: {} of triangle {} has no neighbour", edge, place / 3 + 1);
      return refused("is inverted in part: triangles {} and {} both run along {}", place / 3 + 1,
                     (begin + 1)->place / 3 + 1, edge);
    }
    begin = end;
  }
  const double inside = volume(triangles);
  if (inside > 0) return {};
  return refused("is inverted: its volume is {}; turn its triangles round", inside);
}

double volume(const std::vector<Triangle>& triangles) {
  double six = 0;
  const Vec3 origin = triangles.empty() ? Vec3{} : triangles.front()[0];
  for (const auto& [a, b, c] : triangles) six += dot(a - origin, cross(b - origin, c - origin));
  return six / 6;
}

}  // namespace fitgauge::machine
