BEGIN PGM BOLTS MM
; Three holes of a bolt circle: good, on the limit, beyond it, off their centre.
TOOL CALL 30 Z
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60.05 ~
    Q289=+59.95 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+1 ~
    Q309=+0 ~
    Q330=+0
Q1601 = Q180 * 100 + Q181 * 10 + Q182
; on the upper limit
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60.02 ~
    Q289=+59.95 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60.0199 ~
    Q289=+59.95 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60.05 ~
    Q289=+60.02 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60.05 ~
    Q289=+60.0201 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; centre out of tolerance
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60.05 ~
    Q289=+59.95 ~
    Q279=+0.0099 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; stops: too large
TCH PROBE 430 MEAS. BOLT HOLE CIRC ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+60 ~
    Q291=+0 ~
    Q292=+90 ~
    Q293=+180 ~
    Q261=-5 ~
    Q260=+20 ~
    Q288=+60 ~
    Q289=+59.95 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+1 ~
    Q330=+0
END PGM BOLTS MM
