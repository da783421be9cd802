#pragma once

#include "nc/klartext/statement.hpp"

namespace fitgauge::klartext {

/// The largest numbers that a program can name.
inline constexpr unsigned kLargestBlockNumber = 999'999'999;
inline constexpr unsigned kLargestCycle = 9999;
inline constexpr unsigned kLargestLabel = 65534;

/// One logical line: optional skip mark `/`, optional block number, statement, optional comment.
struct Block {
  [[no_unique_address]] Statement statement{};  ///< its last bytes are used by derived data
  bool has_number = false;                      ///< it is written
  bool skip = false;          ///< `/`: passed over while the operator's block skip is on
  bool comment_mark = false;  ///< a `;` is there, perhaps with an empty comment
  /// Block number as written; it has no effect and may repeat. A block without a number continues
  /// from the number before it, from 0, as on the control.
  std::uint32_t number = 0;
  Slice<char> written{};  ///< its place in the source, with all physical lines
  Text comment{};         ///< after `;` as written; of a cycle, of its first line

  /// The statement if it is of that kind, or null.
  template <class Kind>
  const Kind* as() const {
    return std::get_if<Kind>(&statement);
  }
  /// Whether the statement is of one of these kinds.
  template <class... Kinds>
  bool is() const {
    return (std::holds_alternative<Kinds>(statement) || ...);
  }
};

static_assert(std::is_trivially_copyable_v<Block> && sizeof(Block) == 56,
              "a long program is one array of blocks");

/// Pools that the parser fills and a Program freezes, in the order of the source.
struct ProgramParts {
  std::string file_name{};  ///< as given by the caller
  std::string source{};     ///< UTF-8, lines end with LF, no byte order mark
  std::vector<std::uint32_t> line_starts{};
  std::vector<Block> blocks{};
  std::vector<Word> words{};
  std::vector<CycleParameter> cycle_parameters{};
  std::vector<Node> nodes{};
  std::vector<Expr> operands{};
  std::string texts{};

  /// Returns the most memory of the pools: twice the size of a grown one, that of a reserved one.
  std::size_t memory_bytes() const;
};

/// A parsed program: immutable, so any number of threads may read it. It owns its source and
/// everything that its blocks refer to. Its views are valid while it lives and is not moved.
class Program {
 public:
  Program() = default;
  explicit Program(ProgramParts parts) : parts_(std::move(parts)) {}

  std::string_view file_name() const { return parts_.file_name; }
  std::string_view source() const { return parts_.source; }
  const ProgramParts& parts() const { return parts_; }

  /// Moves the program to the text that its source was made of; `place` maps places here to places
  /// there, while this source exists.
  Program translated(std::string&& source, const std::function<Slice<char>(Slice<char>)>& place) &&;

  /// All blocks in order. Without errors BEGIN PGM is first (after comments), END PGM last.
  std::span<const Block> blocks() const { return parts_.blocks; }

  /// Unit of BEGIN PGM.
  Unit unit() const;

  std::string_view text(Text text) const {
    return std::string_view(parts_.texts).substr(text.first, text.size);
  }
  std::span<const Word> view(Slice<Word> slice) const { return part(parts_.words, slice); }
  std::span<const Expr> view(Slice<Expr> slice) const { return part(parts_.operands, slice); }
  std::span<const CycleParameter> view(Slice<CycleParameter> slice) const {
    return part(parts_.cycle_parameters, slice);
  }
  const Node& node(NodeIndex index) const { return parts_.nodes[index.value]; }
  std::span<const Expr> operands(NodeIndex index) const { return view(node(index).operands); }

  /// The source text of a place.
  std::string_view written(Slice<char> place) const {
    return source().substr(place.first, place.count);
  }
  /// Lines and columns of a place, columns in characters. Computed on demand.
  SourceRange range(Slice<char> place) const;
  /// A physical line (from 1) without its line end.
  std::string_view line(std::uint32_t number) const;

 private:
  template <class T>
  static std::span<const T> part(const std::vector<T>& pool, Slice<T> slice) {
    return std::span(pool).subspan(slice.first, slice.count);
  }

  ProgramParts parts_;
};

/// The bytes of a control file as text: UTF-8 without byte order mark (Windows-1252 is converted
/// when the bytes are not valid UTF-8), every line ending CRLF, LF or CR as LF.
std::string decode_source(std::string bytes);

/// Returns the number of line ends plus 1.
std::size_t count_lines(std::string_view source);

/// Returns the place of an offset; `line_starts` has the offset of each line's first byte.
SourcePosition position_of(std::string_view source, const std::vector<std::uint32_t>& line_starts,
                           std::size_t offset);

/// The line (from 1) without its line end, or nothing when there is no such line.
std::string_view line_of(std::string_view source, const std::vector<std::uint32_t>& line_starts,
                         std::uint32_t number);

}  // namespace fitgauge::klartext
