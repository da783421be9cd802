#include "service/log/log_keys.hpp"

#include <fstream>

#include "base/digest.hpp"
#include "base/folder.hpp"
#include "db/sqlite/data_directory.hpp"

namespace fitgauge::app {
namespace {

constexpr std::string_view kNextKey = "\nnext key ";

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 64;
constexpr std::size_t kDigitsInIds = 16;

Error failed(std::string_view doing, const fs::path& file) {
  return {ErrorCode::StorageUnavailable, fmt::format("cannot {} {}", doing, file.string())};
}

Result<void> replace(const fs::path& file, std::string_view content, fs::perms rights,
                     bool durably) {
  fs::path draft = file;
  draft += ".new";
  std::error_code failure;
  fs::remove(draft, failure);
  TRY(store::reserve_name(draft));
  fs::permissions(draft, rights, failure);
  if (failure) return failed("protect", draft);
  std::ofstream out(draft, std::ios::binary);
  if (!(out << content).flush()) return failed("write", draft);
  out.close();
  if (durably) TRY(store::sync_file(draft));
  fs::rename(draft, file, failure);
  if (failure) return failed("replace", file);
  return durably ? store::sync_file(file) : Result<void>();
}

}  // namespace

std::string digits_of_origin(const std::array<std::uint8_t, 16>& origin) {
  return to_hex(origin).substr(0, kDigitsInIds);
}

std::vector<tlog::VerifierKey> TreeNames::keys(const std::vector<std::string>& texts) const {
  std::vector<tlog::VerifierKey> keys;
  for (const std::string& text : texts) {
    const auto key = tlog::VerifierKey::parse(text);
    if (key) keys.push_back(key->named(name(key->name())));
  }
  return keys;
}

bool is_origin_name(std::string_view name) {
  const auto is_plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
  return !name.empty() && name.size() <= kLongestName && is_plain(name.front()) &&
         std::ranges::all_of(
             name, [&](char c) { return is_plain(c) || c == '.' || c == '/' || c == '-'; });
}

Result<std::vector<tlog::SigningKey>> read_log_keys(const fs::path& folder) {
  const fs::path file = folder / kLogKeyFile;
  std::vector<tlog::SigningKey> keys;
  const auto text = TRY(read_small_file(file));
  if (!text) return keys;
  std::string_view rest = *text;
  while (!rest.empty()) {
    const auto key = tlog::SigningKey::parse(take_field(rest, '\n'));
    if (!key) {
      return Error{
          ErrorCode::KeyMalformed,
          fmt::format("{}: {}; put the key back, or move the file away to begin with a new "
                      "key",
                      file.string(), key.error().message)};
    }
    keys.push_back(*key);
  }
  return keys;
}

Result<void> write_log_keys(const fs::path& folder, const std::vector<tlog::SigningKey>& keys) {
  std::string text;
  for (const tlog::SigningKey& key : keys) text += key.text() + "\n";
  return replace(folder / kLogKeyFile, text, fs::perms::owner_read | fs::perms::owner_write, true);
}

Result<std::string> renew_log_key(const fs::path& folder) {
  auto keys = TRY(read_log_keys(folder));
  if (keys.empty()) {
    return Error{
        ErrorCode::StorageUnavailable,
        fmt::format("{} has no {}: start fitgauged once to make it", folder.string(), kLogKeyFile)};
  }
  const std::string name = keys.front().verifier().name();
  const auto older =
      std::ranges::find_if(keys, [&](const auto& key) { return key.verifier().name() != name; });
  const auto made = tlog::SigningKey::make(name);
  std::vector<tlog::SigningKey> all{made};
  // Removes a new key that no start has used; those of former histories stay.
  all.insert(all.end(), std::prev(older), keys.end());
  TRY(write_log_keys(folder, all));
  return made.verifier().text();
}

std::string next_key_line(const tlog::VerifierKey& key) {
  return fmt::format("{}{}\n", kNextKey.substr(1), key.text());
}

std::optional<tlog::VerifierKey> next_key_of(std::string_view text) {
  const std::size_t at = text.find(kNextKey);
  if (at == text.npos) return std::nullopt;
  const std::size_t begin = at + kNextKey.size();
  const auto key = tlog::VerifierKey::parse(
      text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin));
  return key ? std::optional(*key) : std::nullopt;
}

Result<void> keep_file(const fs::path& file, std::string_view content, bool durably) {
  return replace(file, content,
                 fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read, durably);
}

Result<std::optional<std::string>> read_small_file(const fs::path& file) {
  std::error_code failure;
  if (!fs::exists(file, failure) && !failure) return std::optional<std::string>();
  auto text = read_regular(file);
  if (text) return std::optional(*std::move(text));
  return Error{ErrorCode::StorageUnavailable,
               fmt::format("cannot read {}: {}", file.string(), text.error().message)};
}

}  // namespace fitgauge::app
