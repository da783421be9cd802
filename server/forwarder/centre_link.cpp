#include "forwarder/centre_link.hpp"

#include <curl/curl.h>
#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "base/text.hpp"

namespace fitgauge::forwarder {
namespace {

constexpr long kConnectSeconds = 10;
constexpr long kRequestSeconds = 60;
constexpr std::size_t kLongestAnswer = std::size_t{64} << 10;

struct HeaderList {
  HeaderList() = default;
  HeaderList(const HeaderList&) = delete;
  HeaderList& operator=(const HeaderList&) = delete;
  ~HeaderList() { curl_slist_free_all(first); }
  void add(const std::string& line) { first = curl_slist_append(first, line.c_str()); }

  curl_slist* first = nullptr;
};

std::size_t take_body(char* data, std::size_t, std::size_t size, void* user) {
  auto& body = *static_cast<std::string*>(user);
  if (body.size() + size > kLongestAnswer) return 0;
  body.append(data, size);
  return size;
}

int look_around(void* user, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return (*static_cast<const std::function<bool()>*>(user))() ? 0 : 1;
}

/// RFC 1952. The fastest level: records are much alike, and their station has other work.
std::string gzip(std::string_view text) {
  constexpr int kWindowOfGzip = 15 + 16;
  constexpr int kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kWindowOfGzip, kMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::runtime_error("zlib has no memory");
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(text.size())), '\0');
  // zlib does not write to what it reads.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// The first line of the file. @returns false when it cannot be read.
bool read_key(const std::string& file, std::string& key) {
  std::ifstream in(file);
  std::getline(in, key);
  key = trim(key);
  return !in.bad() && !key.empty();
}

}  // namespace

struct CentreLink::Handle {
  Handle() : curl(curl_easy_init()) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { curl_easy_cleanup(curl); }

  template <class Value>
  void set(CURLoption option, Value value) {
    curl_easy_setopt(curl, option, value);
  }

  CURL* curl;
  std::array<char, CURL_ERROR_SIZE> error{};
};

CentreLink::CentreLink(CentreOptions options)
    : options_(std::move(options)), handle_(std::make_unique<Handle>()) {}
CentreLink::~CentreLink() = default;

CentreAnswer CentreLink::put(const std::string& path, std::string_view ndjson,
                             const std::function<bool()>& waiting) {
  CentreAnswer answer;
  HeaderList headers;
  headers.add("Expect:");
  headers.add("Content-Type: application/x-ndjson");
  headers.add("Content-Encoding: gzip");
  if (!options_.key_file.empty()) {
    std::string key;
    if (!read_key(options_.key_file, key)) {
      answer.failure = fmt::format("cannot read a key from {}", options_.key_file);
      return answer;
    }
    headers.add("Authorization: Bearer " + key);
  }
  const std::string url = options_.url + path;
  const std::string body = gzip(ndjson);
  Handle& handle = *handle_;
  curl_easy_reset(handle.curl);  // the options, not the connection
  handle.error.front() = '\0';
  handle.set(CURLOPT_URL, url.c_str());
  handle.set(CURLOPT_PROTOCOLS_STR, "http,https");
  handle.set(CURLOPT_USERAGENT, "fitgauge/" FITGAUGE_VERSION);
  handle.set(CURLOPT_NOSIGNAL, 1L);
  handle.set(CURLOPT_CONNECTTIMEOUT, kConnectSeconds);
  handle.set(CURLOPT_TIMEOUT, kRequestSeconds);
  if (!options_.authorities.empty()) {
    handle.set(CURLOPT_CAINFO, options_.authorities.c_str());
  }
  handle.set(CURLOPT_NOPROGRESS, 0L);
  handle.set(CURLOPT_XFERINFOFUNCTION, &look_around);
  handle.set(CURLOPT_XFERINFODATA, &waiting);
  handle.set(CURLOPT_WRITEFUNCTION, &take_body);
  handle.set(CURLOPT_WRITEDATA, &answer.body);
  handle.set(CURLOPT_ERRORBUFFER, handle.error.data());
  handle.set(CURLOPT_HTTPHEADER, headers.first);
  handle.set(CURLOPT_CUSTOMREQUEST, "PUT");
  handle.set(CURLOPT_POSTFIELDS, body.data());
  handle.set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));

  const CURLcode code = curl_easy_perform(handle.curl);
  curl_easy_getinfo(handle.curl, CURLINFO_RESPONSE_CODE, &answer.status);
  if (code == CURLE_OK) return answer;
  answer.status = 0;
  answer.failure = handle.error.front() == '\0' ? curl_easy_strerror(code) : handle.error.data();
  return answer;
}

}  // namespace fitgauge::forwarder
