#pragma once

namespace fitgauge::http {

/// Refusal of a request before its handler runs.
struct Refusal {
  int status = 400;
  ErrorCode code = ErrorCode::RequestMalformed;
  std::string message;
};

struct HeaderField {
  std::string_view name;
  std::string_view value;
};

/// The request line and the header fields, as views into the connection's buffer.
struct RequestHead {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  std::optional<std::uint64_t> content_length;
  bool http_1_0 = false;
  bool chunked = false;
  bool keep_alive = false;
  bool has_accept = false;
  bool has_expect = false;
  bool has_if_none_match = false;
  bool has_accept_encoding = false;
  bool has_origin = false;
  bool has_request_id = false;
  bool is_forwarded = false;  ///< a proxy has added its field
  std::vector<HeaderField> fields;

  /// The value of the first field of that name.
  std::optional<std::string_view> find(std::string_view name) const;
  /// All fields of that name joined with ", ".
  std::optional<std::string> find_list(std::string_view name) const;

  bool has_body() const { return chunked || content_length.value_or(0) > 0; }

  /// Empty again; the memory of an ordinary number of `fields` stays.
  void clear();

  /// Moves every view by the distance between the two buffers.
  void rebase(const char* from, const char* to);
};

/// Appends `text` with its %XX decoded (and `+` as a blank when asked for).
/// @returns false for an incomplete or non-hexadecimal %XX, a NUL, or bytes that are not UTF-8.
bool append_percent_decoded(std::string& out, std::string_view text, bool plus_is_blank);

namespace detail {
inline constexpr std::array<bool, 256> kPlainCharacters = [] {
  std::array<bool, 256> table{};
  for (std::size_t c = '!'; c <= '~'; ++c) table[c] = c != '%' && c != '+';
  return table;
}();
}  // namespace detail

/// Characters that need neither decoding nor a check: printable ASCII but for `%` and `+`.
constexpr bool is_plain(char c) { return detail::kPlainCharacters[static_cast<unsigned char>(c)]; }

/// host [":" port] as the Host field has it (RFC 3986 section 3.2.2, without user information).
bool is_authority(std::string_view text);

}  // namespace fitgauge::http
