BEGIN PGM INCLINED MM
; The edge y = -x tan 3 looked for at -3.4 degrees from 20, -1 on, touched square to that line after 10 and 50 mm.
TOOL CALL 30 Z
L C+3 FMAX
TCH PROBE 1412 INCLINED EDGE PROBING ~
    Q1100=+20 ~
    Q1101=-1 ~
    Q1102=-5 ~
    QS400="0.2-0.2" ~
    Q1130=-3.4 ~
    Q1131=+1 ~
    Q1132=+10 ~
    Q1133=+50 ~
    Q1139=+3 ~
    Q320=+1 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+1 ~
    Q1121=+1
Q1601 = Q950
Q1602 = Q951
Q1603 = Q953
Q1604 = Q954
Q1605 = Q964
Q1606 = Q994
Q1607 = Q183
TCH PROBE 1412 INCLINED EDGE PROBING ~
    Q1100=+20 ~
    Q1101=-1 ~
    Q1102=-5 ~
    QS400="0.2-0.2" ~
    Q1130=-3.4 ~
    Q1131=+1 ~
    Q1132=+10 ~
    Q1133=+50 ~
    Q1139=+3 ~
    Q320=+1 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
Q1611 = Q980
Q1612 = Q981
Q1613 = Q994
Q1614 = Q183
; without tolerance, good, rework, reject
QL1 = -1
QS1 = ""
LBL 9
TCH PROBE 1412 INCLINED EDGE PROBING ~
    Q1100=+20 ~
    Q1101=+QL1 ~
    Q1102=-5 ~
    QS400=QS1 ~
    Q1130=-3.4 ~
    Q1131=+1 ~
    Q1132=+10 ~
    Q1133=+50 ~
    Q1139=+3 ~
    Q320=+1 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1126=+0 ~
    Q1120=+0 ~
    Q1121=+0
LBL 0
Q1691 = Q183
QL1 = -1
QS1 = "0.5-0.5"
CALL LBL 9
Q1692 = Q183
QL1 = +0
QS1 = "0.1-0.1"
CALL LBL 9
Q1693 = Q183
QL1 = -2
QS1 = "0.1-0.1"
CALL LBL 9
Q1694 = Q183
END PGM INCLINED MM
