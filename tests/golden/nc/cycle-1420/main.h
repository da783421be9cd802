BEGIN PGM PLANE MM
; The plane z = 0.02 x - 0.0125 y, transferred with its rotation and the 1st point; the second probing, elsewhere, finds it level.
TOOL CALL 30 Z
TCH PROBE 1420 PROBING IN PLANE ~
    Q1100=+20 ~
    Q1101=+20 ~
    Q1102=+0 ~
    Q1103=+80 ~
    Q1104=+20 ~
    Q1105=+0 ~
    Q1106=+50 ~
    Q1107=+60 ~
    Q1108=+0 ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+1 ~
    Q1121=+1
Q1601 = Q952
Q1602 = Q955
Q1603 = Q958
Q1604 = Q961
Q1605 = Q962
Q1606 = Q963
Q1607 = Q991
Q1608 = Q992
Q1609 = Q993
TCH PROBE 1420 PROBING IN PLANE ~
    Q1100=+30 ~
    Q1101=+30 ~
    Q1102=+0 ~
    Q1103=+70 ~
    Q1104=+25 ~
    Q1105=+0 ~
    Q1106=+40 ~
    Q1107=+55 ~
    QS1108="0+-0.01" ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+2 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
Q1611 = Q982
Q1612 = Q985
Q1613 = Q988
Q1614 = Q991
Q1615 = Q992
Q1616 = Q183
; without tolerance, good, rework, reject
QS1 = "0"
LBL 9
TCH PROBE 1420 PROBING IN PLANE ~
    Q1100=+20 ~
    Q1101=+20 ~
    QS1102=QS1 ~
    Q1103=+80 ~
    Q1104=+20 ~
    Q1105=+0 ~
    Q1106=+50 ~
    Q1107=+60 ~
    Q1108=+0 ~
    Q372=-3 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
LBL 0
Q1691 = Q183
QS1 = "0+-0.1"
CALL LBL 9
Q1692 = Q183
QS1 = "-0.5+-0.1"
CALL LBL 9
Q1693 = Q183
QS1 = "0.5+-0.1"
CALL LBL 9
Q1694 = Q183
END PGM PLANE MM
