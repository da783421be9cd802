-- wrk: every request posts one measurement with a part id of its own. All are of one length, so that
-- all but the digits is put together once.
local threads = 0

function setup(thread)
  thread:set("number", threads)
  threads = threads + 1
end

function init()
  count = 0
  local before = '{"nominal_mm":25,"tolerance_class":"H7","measured_mm":25.'
  middle = string.format(',"part_id":"T%02d-', number)
  after = '","characteristic":"bore-A","order":"WO-17","operation":"OP20","machine":"M3",' ..
    '"operator":"42","gauge":"G-07"}'
  local length = #before + 6 + #middle + 8 + #after
  head = "POST /v1/measurements HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n" ..
    "Content-Length: " .. length .. "\r\n\r\n" .. before
end

function request()
  count = count + 1
  return head .. string.format("%06d", count % 30000) .. middle .. string.format("%08d", count) .. after
end
