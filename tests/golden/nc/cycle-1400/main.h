BEGIN PGM POSITION MM
; The top of a part 0.0234 high: beyond +0.02, so it is rework. Q1120 moves the zero of preset 1 by the deviation from the
; middle of the tolerance, 0.0234 - 0.005; the second touch then finds the middle. Then a side, between and without the clearance height.
TOOL CALL 30 Z
TCH PROBE 1400 POSITION PROBING ~
    Q1100=+30 ~
    Q1101=+40 ~
    QS1102="0+0.02-0.01" ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+1
Q1601 = Q183
Q1602 = Q952
Q1603 = Q982
TCH PROBE 1400 POSITION PROBING ~
    Q1100=+30 ~
    Q1101=+40 ~
    QS1102="0+0.02-0.01" ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+2 ~
    Q309=+0 ~
    Q1120=+0
Q1611 = Q183
Q1612 = Q952
Q1613 = Q982
FN 18: SYSREAD Q1614 = ID503 NR1 IDX3
TCH PROBE 1400 POSITION PROBING ~
    QS1100="0.01+-0.005" ~
    Q1101=+40 ~
    Q1102=-10 ~
    Q372=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=-1 ~
    Q309=+0 ~
    Q1120=+0
Q1621 = Q183
Q1622 = Q950
Q1623 = Q980
; without tolerance, good, rework, reject
QS1 = "0"
LBL 9
TCH PROBE 1400 POSITION PROBING ~
    QS1100=QS1 ~
    Q1101=+40 ~
    Q1102=-10 ~
    Q372=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=-1 ~
    Q309=+0 ~
    Q1120=+0
LBL 0
Q1691 = Q183
QS1 = "0+-0.1"
CALL LBL 9
Q1692 = Q183
QS1 = "0.5+-0.1"
CALL LBL 9
Q1693 = Q183
QS1 = "-0.5+-0.1"
CALL LBL 9
Q1694 = Q183
L Z+50 FMAX
M30
END PGM POSITION MM
