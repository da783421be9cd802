BEGIN PGM EDGE MM
; C+3 turns the part by -3 degrees around the zero: its edge is y = -x tan 3. The nominal line goes from -0.5, the middle of the
; tolerance, at X20 to 0 at X80. Transferred by point 1 with a basic rotation,
; the second probing finds the nominal line. Then the slope of the top, and the offset of the table.
TOOL CALL 30 Z
L C+3 FMAX
TCH PROBE 1410 PROBING ON EDGE ~
    Q1100=+20 ~
    QS1101="0+1-2" ~
    Q1102=-5 ~
    Q1103=+80 ~
    Q1104=+0 ~
    Q1105=-5 ~
    Q372=+2 ~
    Q320=+6 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+1 ~
    Q1121=+1
Q1601 = Q951
Q1602 = Q954
Q1603 = Q964
Q1604 = Q965
Q1605 = Q994
Q1606 = Q183
FN 18: SYSREAD Q1607 = ID210 NR1
TCH PROBE 1410 PROBING ON EDGE ~
    Q1100=+20 ~
    Q1101=-0.5 ~
    Q1102=-5 ~
    Q1103=+80 ~
    Q1104=-0.5 ~
    Q1105=-5 ~
    Q372=+2 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
Q1611 = Q981
Q1612 = Q984
Q1613 = Q994
TCH PROBE 1410 PROBING ON EDGE ~
    Q1100=+20 ~
    Q1101=+30 ~
    Q1102=+0 ~
    Q1103=+80 ~
    Q1104=+30 ~
    Q1105=+0 ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+2 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+3 ~
    Q1121=+0
Q1621 = Q952
Q1622 = Q994
; the offset of the table: it turns, and reads what it read
CYCL DEF 247 PRESETTING Q339=+1
TCH PROBE 404 SET BASIC ROTATION Q307=+0 Q305=-1
TCH PROBE 1410 PROBING ON EDGE ~
    Q1100=+20 ~
    Q1101=+0 ~
    Q1102=-5 ~
    Q1103=+80 ~
    Q1104=+0 ~
    Q1105=-5 ~
    Q372=+2 ~
    Q320=+6 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+1 ~
    Q1120=+0 ~
    Q1121=+2
FN 18: SYSREAD Q1631 = ID270 NR1 IDX6
TCH PROBE 1410 PROBING ON EDGE ~
    Q1100=+20 ~
    Q1101=+0 ~
    Q1102=-5 ~
    Q1103=+80 ~
    Q1104=+0 ~
    Q1105=-5 ~
    Q372=+2 ~
    Q320=+6 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
Q1632 = Q994
; without tolerance, good, rework, reject
QS1 = "0"
LBL 9
TCH PROBE 1410 PROBING ON EDGE ~
    Q1100=+20 ~
    QS1101=QS1 ~
    Q1102=-5 ~
    Q1103=+80 ~
    Q1104=+0 ~
    Q1105=-5 ~
    Q372=+2 ~
    Q320=+6 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
LBL 0
Q1691 = Q183
QS1 = "-0.7+-0.1"
CALL LBL 9
Q1692 = Q183
QS1 = "0+-0.1"
CALL LBL 9
Q1693 = Q183
QS1 = "-2+-0.5"
CALL LBL 9
Q1694 = Q183
L Z+50 FMAX
M30
END PGM EDGE MM
