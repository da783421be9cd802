BEGIN PGM TWO MM
; Two holes 60 and 0.5 apart: atan(0.5 / 60) turned. The mean is transferred with the basic rotation; then the middle lies
; where it should and each hole 0.0010417 further out. Before, a hole and a stud.
TOOL CALL 30 Z
TCH PROBE 1411 PROBING TWO CIRCLES ~
    Q1100=+20 ~
    Q1101=+20 ~
    Q1102=-5 ~
    QS1116="12" ~
    Q1103=+160 ~
    Q1104=+20 ~
    Q1105=+10 ~
    Q1117=+25 ~
    Q1115=+2 ~
    Q423=+3 ~
    Q325=+0 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+50 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
Q1621 = Q967
Q1622 = Q964
TCH PROBE 1411 PROBING TWO CIRCLES ~
    Q1100=+20 ~
    Q1101=+20 ~
    Q1102=-5 ~
    QS1116="12+0.02" ~
    Q1103=+80 ~
    Q1104=+20 ~
    Q1105=-5 ~
    QS1117="14+0.01" ~
    Q1115=+0 ~
    Q423=+3 ~
    Q325=+0 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+3 ~
    Q1121=+1
Q1601 = Q964
Q1602 = Q994
Q1603 = Q966
Q1604 = Q967
Q1605 = Q984
Q1606 = Q183
TCH PROBE 1411 PROBING TWO CIRCLES ~
    Q1100=+20 ~
    Q1101=+20 ~
    Q1102=-5 ~
    Q1116=+12 ~
    Q1103=+80 ~
    Q1104=+20 ~
    Q1105=-5 ~
    Q1117=+14 ~
    Q1115=+0 ~
    Q423=+4 ~
    Q325=+0 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+2 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
Q1611 = Q980
Q1612 = Q981
Q1613 = Q983
Q1614 = Q984
Q1615 = Q994
; without tolerance, good, rework, reject
QS1 = "12"
LBL 9
TCH PROBE 1411 PROBING TWO CIRCLES ~
    Q1100=+20 ~
    Q1101=+20 ~
    Q1102=-5 ~
    QS1116=QS1 ~
    Q1103=+80 ~
    Q1104=+20 ~
    Q1105=-5 ~
    Q1117=+14 ~
    Q1115=+0 ~
    Q423=+3 ~
    Q325=+0 ~
    Q1119=+360 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
LBL 0
Q1691 = Q183
QS1 = "12+0.02"
CALL LBL 9
Q1692 = Q183
QS1 = "12.1+0.01"
CALL LBL 9
Q1693 = Q183
QS1 = "12+0.005"
CALL LBL 9
Q1694 = Q183
END PGM TWO MM
