#pragma once

#include "base/result.hpp"
#include "daemon/config.hpp"
#include "service/documents/key_service.hpp"

namespace fitgauge::daemon {

/// The first line of the file, without blanks around it.
/// @errors ConfigInvalid naming the file: it cannot be read, or holds no key.
Result<std::string> read_admin_key(const std::string& file);

/// The file that receives the administrator's key of the first start.
std::string admin_key_out(const Config& config);

/// What a start does about the administrator's key. With a file, its key is valid afterwards: a key
/// that an earlier file gave and this one does not is revoked, and the log says so. Without a file
/// the first start that `needs_one` makes a key and writes it to admin_key_out(), with mode 0600;
/// the log has the path. A key that was revoked stays revoked.
/// @errors ConfigInvalid, and those of the storage.
Result<void> provide_admin_key(const Config& config, bool needs_one, app::KeyService& keys);

}  // namespace fitgauge::daemon
