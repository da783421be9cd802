BEGIN PGM CIRCLE MM
; The hole of cycle 421's log against 12H7 (0 to +0.018, middle 12.009): 12.0259 is too large. A stud of 24.98 against 25h9
; (-0.052 to 0, middle 24.974), on half its circumference, with its centre transferred into preset 1.
TOOL CALL 30 Z
TCH PROBE 1401 CIRCLE PROBING ~
    Q1100=+50 ~
    QS1101="65+-0.05" ~
    Q1102=-5 ~
    QS1116="12H7" ~
    Q1115=+0 ~
    Q423=+4 ~
    Q325=+0 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
Q1601 = Q183
Q1602 = Q950
Q1603 = Q951
Q1604 = Q966
Q1605 = Q980
Q1606 = Q981
Q1607 = Q996
TCH PROBE 1401 CIRCLE PROBING ~
    Q1100=+120.1 ~
    Q1101=+79.9 ~
    Q1102=+20 ~
    QS1116="25h9" ~
    Q1115=+1 ~
    Q423=+5 ~
    Q325=-30 ~
    Q1119=+180 ~
    Q320=+0 ~
    Q260=+60 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+1
Q1611 = Q183
Q1612 = Q950
Q1613 = Q951
Q1614 = Q966
Q1615 = Q996
TCH PROBE 1401 CIRCLE PROBING ~
    Q1100=+120.1 ~
    Q1101=+79.9 ~
    Q1102=+20 ~
    QS1116="25m" ~
    Q1115=+1 ~
    Q423=+3 ~
    Q325=+10 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+60 ~
    Q1125=+0 ~
    Q309=+0 ~
    Q1120=+0
Q1621 = Q183
Q1622 = Q980
Q1623 = Q981
Q1624 = Q996
; without tolerance, good, rework, reject
QS1 = "12"
LBL 9
TCH PROBE 1401 CIRCLE PROBING ~
    Q1100=+50 ~
    Q1101=+65 ~
    Q1102=-5 ~
    QS1116=QS1 ~
    Q1115=+0 ~
    Q423=+4 ~
    Q325=+0 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
LBL 0
Q1691 = Q183
QS1 = "12+0.03"
CALL LBL 9
Q1692 = Q183
QS1 = "12.1+0.01"
CALL LBL 9
Q1693 = Q183
QS1 = "12+0.01"
CALL LBL 9
Q1694 = Q183
END PGM CIRCLE MM
