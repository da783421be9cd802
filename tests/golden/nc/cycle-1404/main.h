BEGIN PGM WIDTH MM
; A slot from 40 to 60.012 against 20H8 (0 to +0.033, middle 20.0165), its centre transferred; a ridge from 120 to 150.03
; against 30-0.1, which is too wide; its length 70.004 with Q1114 = 90, over the clearance height although Q1125 = 0.
TOOL CALL 30 Z
TCH PROBE 1404 PROBE SLOT/RIDGE ~
    Q1100=+50.01 ~
    Q1101=+40 ~
    Q1102=-10 ~
    QS1113="20H8" ~
    Q1115=+0 ~
    Q1114=+0 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+1
Q1601 = Q183
Q1602 = Q950
Q1603 = Q968
Q1604 = Q980
Q1605 = Q998
; the zero stands 0.004 further left
TCH PROBE 1404 PROBE SLOT/RIDGE ~
    Q1100=+135 ~
    Q1101=+35 ~
    Q1102=-10 ~
    QS1113="30-0.1" ~
    Q1115=+1 ~
    Q1114=+0 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
Q1611 = Q183
Q1612 = Q950
Q1613 = Q968
Q1614 = Q998
TCH PROBE 1404 PROBE SLOT/RIDGE ~
    Q1100=+135 ~
    Q1101=+35 ~
    Q1102=-10 ~
    Q1113=+70 ~
    Q1115=+1 ~
    Q1114=+90 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+0 ~
    Q309=+0 ~
    Q1120=+0
Q1621 = Q183
Q1622 = Q951
Q1623 = Q968
Q1624 = Q998
; without tolerance, good, rework, reject
QS1 = "20"
LBL 9
TCH PROBE 1404 PROBE SLOT/RIDGE ~
    Q1100=+50.01 ~
    Q1101=+40 ~
    Q1102=-10 ~
    QS1113=QS1 ~
    Q1115=+0 ~
    Q1114=+0 ~
    Q320=+0 ~
    Q260=+30 ~
    Q1125=+1 ~
    Q309=+0 ~
    Q1120=+0
LBL 0
Q1691 = Q183
QS1 = "20+0.02"
CALL LBL 9
Q1692 = Q183
QS1 = "20.1+-0.01"
CALL LBL 9
Q1693 = Q183
QS1 = "20+0.01"
CALL LBL 9
Q1694 = Q183
END PGM WIDTH MM
