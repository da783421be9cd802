#include "http/client/curl_handle.hpp"

#include <utility>

#include "base/retry_after.hpp"

namespace fitgauge::http_client {

CurlHandle::~CurlHandle() {
  curl_easy_cleanup(curl_);
  curl_slist_free_all(headers_);
}

void CurlHandle::begin(const std::string& url, const std::string& method,
                       std::span<const std::string> headers, std::string_view body) {
  curl_easy_reset(curl_);  // the options, not the connection
  curl_slist_free_all(std::exchange(headers_, nullptr));
  headers_ = curl_slist_append(headers_, "Expect:");
  for (const std::string& line : headers) headers_ = curl_slist_append(headers_, line.c_str());
  retry_after_.reset();
  error_.front() = '\0';
  set_text(CURLOPT_URL, url);
  set_text(CURLOPT_CUSTOMREQUEST, method);
  set(CURLOPT_PROTOCOLS_STR, "http,https");
  set(CURLOPT_USERAGENT, "fitgauge/" FITGAUGE_VERSION);
  set(CURLOPT_NOSIGNAL, 1L);
  set(CURLOPT_HTTPHEADER, headers_);
  set(CURLOPT_HEADERFUNCTION, &take_header);
  set(CURLOPT_HEADERDATA, this);
  set(CURLOPT_ERRORBUFFER, error_.data());
  if (method == "GET") return;
  set(CURLOPT_POSTFIELDS, body.data() == nullptr ? "" : body.data());
  set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
}

std::size_t CurlHandle::take_header(char* data, std::size_t, std::size_t size, void* handle) {
  if (const auto wait = fitgauge::retry_after({data, size})) {
    static_cast<CurlHandle*>(handle)->retry_after_ = *wait;
  }
  return size;
}

long CurlHandle::status() const {
  long status = 0;
  curl_easy_getinfo(curl_, CURLINFO_RESPONSE_CODE, &status);
  return status;
}

std::string CurlHandle::content_type() const {
  const char* type = nullptr;
  curl_easy_getinfo(curl_, CURLINFO_CONTENT_TYPE, &type);
  return type == nullptr ? "" : type;
}

std::string CurlHandle::reason(CURLcode code) const {
  return error_.front() == '\0' ? curl_easy_strerror(code) : error_.data();
}

}  // namespace fitgauge::http_client
