-- wrk: every request posts one measurement; the next thousands have other values and part ids. They
-- are put together beforehand, so that the client takes as little of the processor as can be.
local threads = 0

function setup(thread)
  thread:set("number", threads)
  threads = threads + 1
end

function init()
  local before = '{"nominal_mm":25,"tolerance_class":"H7","measured_mm":25.'
  local middle = string.format(',"part_id":"T%02d-', number)
  local after = '","characteristic":"bore-A","order":"WO-17","operation":"OP20","machine":"M3",' ..
    '"operator":"42","gauge":"G-07"}'
  local length = #before + 6 + #middle + 8 + #after
  local head = "POST /v1/measurements HTTP/1.1\r\nHost: localhost\r\n" ..
    "Content-Type: application/json\r\nContent-Length: " .. length .. "\r\n\r\n" .. before
  requests = {}
  for i = 1, 8192 do
    requests[i] = head .. string.format("%06d", i * 3) .. middle .. string.format("%08d", i) .. after
  end
  count = 0
end

function request()
  count = count % #requests + 1
  return requests[count]
end
