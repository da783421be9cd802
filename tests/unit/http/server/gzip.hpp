#pragma once

namespace fitgauge::http::test {

/// `text` as one gzip member.
std::string gzip(std::string_view text);

}  // namespace fitgauge::http::test
