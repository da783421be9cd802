BEGIN PGM STUD MM
; A stud: good with a corrected tool, on each limit, beyond it, off its centre.
TOOL CALL 30 Z
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+25 ~
    Q278=+24.979 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+1 ~
    Q309=+0 ~
    Q330=+7
Q1601 = Q180 * 100 + Q181 * 10 + Q182
FN 18: SYSREAD Q1600 = ID50 NR5 IDX7
; on the upper limit
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+24.99 ~
    Q278=+24.979 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1602 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um above the upper limit
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+24.9899 ~
    Q278=+24.979 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1603 = Q180 * 100 + Q181 * 10 + Q182
; on the lower limit
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+25 ~
    Q278=+24.99 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1604 = Q180 * 100 + Q181 * 10 + Q182
; 0.1 um below the lower limit
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+25 ~
    Q278=+24.9901 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1605 = Q180 * 100 + Q181 * 10 + Q182
; centre out of tolerance
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+25 ~
    Q278=+24.979 ~
    Q279=+0.05 ~
    Q280=+0.0299 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1606 = Q180 * 100 + Q181 * 10 + Q182
; three touches over the clearance height
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+120 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+1 ~
    Q277=+25 ~
    Q278=+24.979 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0 ~
    Q423=+3
Q1607 = Q180 * 100 + Q181 * 10 + Q182
; stops: too small
TCH PROBE 422 MEAS. CIRCLE OUTSIDE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+10 ~
    Q247=+90 ~
    Q261=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q277=+25 ~
    Q278=+24.995 ~
    Q279=+0.05 ~
    Q280=+0.05 ~
    Q281=+0 ~
    Q309=+1 ~
    Q330=+0
END PGM STUD MM
