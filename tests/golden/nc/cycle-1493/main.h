BEGIN PGM EXTRUSION MM
; A face with a step of 0.02: four touches over 60 mm, two on either part, have their mean at 0.01. The next cycle touches once.
TOOL CALL 30 Z
TCH PROBE 1493 EXTRUSION PROBING ~
    Q372=+2 ~
    Q1145=+3 ~
    Q1146=+60 ~
    Q1149=+0
TCH PROBE 1400 POSITION PROBING ~
    Q1100=+0 ~
    Q1101=+10 ~
    Q1102=-10 ~
    Q372=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
Q1601 = Q950
Q1602 = Q970
TCH PROBE 1400 POSITION PROBING ~
    Q1100=+0 ~
    Q1101=+70 ~
    Q1102=-10 ~
    Q372=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
Q1611 = Q950
M30
END PGM EXTRUSION MM
