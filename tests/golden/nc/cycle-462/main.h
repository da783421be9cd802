BEGIN PGM RING MM
; A ball that is smaller and beside the spindle axis: the ring gauge finds out, the hole is right then.
TOOL CALL 30 Z
; not calibrated: off centre and too large
L Z+200 FMAX
L X+100 Y+80 FMAX
TCH PROBE 421 MEASURE HOLE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q275=+25.021 ~
    Q276=+25 ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1600 = Q151
Q1601 = Q152
Q1602 = Q153
L Z+200 FMAX
L X-200.3 Y+100.2 FMAX
L Z-12 FMAX
TCH PROBE 462 CALIBRATION OF TS IN RING ~
    Q407=+25 ~
    Q320=+1 ~
    Q423=+8 ~
    Q380=+15
FN 18: SYSREAD Q1610 = ID350 NR11
FN 18: SYSREAD Q1611 = ID350 NR12
FN 18: SYSREAD Q1612 = ID350 NR14 IDX1
FN 18: SYSREAD Q1613 = ID350 NR14 IDX2
; the same hole again
L Z+200 FMAX
L X+100 Y+80 FMAX
TCH PROBE 421 MEASURE HOLE ~
    Q273=+100 ~
    Q274=+80 ~
    Q262=+25 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q275=+25.021 ~
    Q276=+25 ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0
Q1620 = Q151
Q1621 = Q152
Q1622 = Q153
END PGM RING MM
