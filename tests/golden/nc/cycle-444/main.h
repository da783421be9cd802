BEGIN PGM SURFACE MM
; Points of a face and of a slope: good, rework and scrap, on each limit, one-sided, without tolerance.
TOOL CALL 30 Z
QL1 = 0 ; Q294
QL2 = 0 ; Q309
LBL 1
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+QL1 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.1-0.1" ~
    Q309=+QL2
LBL 0
Q1601 = Q183
Q1611 = Q164
; on the upper limit
QL1 = -0.1
CALL LBL 1
Q1602 = Q183
Q1612 = Q164
; 0.1 um above the upper limit: rework
QL1 = -0.1001
CALL LBL 1
Q1603 = Q183
Q1613 = Q164
; on the lower limit
QL1 = 0.1
CALL LBL 1
Q1604 = Q183
Q1614 = Q164
; 0.1 um below the lower limit: scrap
QL1 = 0.1001
CALL LBL 1
Q1605 = Q183
Q1615 = Q164
; upper limit only
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=-0.4 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.4" ~
    Q309=+0
Q1606 = Q183
Q1616 = Q164
; lower limit only, decimal comma
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0.2 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="-0,2" ~
    Q309=+0
Q1607 = Q183
Q1617 = Q164
; no tolerance
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400=" " ~
    Q309=+0
Q1608 = Q183
Q1618 = Q164
; no tolerance, both signs alike
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.1+0.1" ~
    Q309=+0
Q1609 = Q183
Q1619 = Q164
; a slope, its normal not of length 1
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+160 ~
    Q264=+40 ~
    Q294=+3 ~
    Q581=-3 ~
    Q582=+0 ~
    Q583=+4 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.02-0.02" ~
    Q309=+0
Q1610 = Q183
Q1620 = Q164
; 0.05 of material too much on the slope
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+160.03 ~
    Q264=+40 ~
    Q294=+2.96 ~
    Q581=-3 ~
    Q582=+0 ~
    Q583=+4 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.02-0.02" ~
    Q309=+0
Q1611 = Q183
Q1621 = Q164
; stops below the lower limit
QL1 = 0.2
QL2 = 2
CALL LBL 1
END PGM SURFACE MM
