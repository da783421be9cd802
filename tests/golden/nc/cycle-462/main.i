%RING G71 *
; A ball that is smaller and beside the spindle axis: the ring gauge finds out, the hole is right then.
N10 T30 G17 *
; not calibrated: off centre and too large
N20 G00 Z+200 *
N30 G00 X+100 Y+80 *
N40 G421 MEASURE HOLE ~
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
    Q330=+0 *
N50 Q1600 = Q151 *
N60 Q1601 = Q152 *
N70 Q1602 = Q153 *
N80 G00 Z+200 *
N90 G00 X-200.3 Y+100.2 *
N100 G00 Z-12 *
N110 G462 CALIBRATION OF TS IN RING ~
    Q407=+25 ~
    Q320=+1 ~
    Q423=+8 ~
    Q380=+15 *
N120 D18: SYSREAD Q1610 = ID350 NR11 *
N130 D18: SYSREAD Q1611 = ID350 NR12 *
N140 D18: SYSREAD Q1612 = ID350 NR14 IDX1 *
N150 D18: SYSREAD Q1613 = ID350 NR14 IDX2 *
; the same hole again
N160 G00 Z+200 *
N170 G00 X+100 Y+80 *
N180 G421 MEASURE HOLE ~
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
    Q330=+0 *
N190 Q1620 = Q151 *
N200 Q1621 = Q152 *
N210 Q1622 = Q153 *
N99999999 %RING G71 *
