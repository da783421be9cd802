%SURFACE G71 *
; Points of a face and of a slope: good, rework and scrap, on each limit, one-sided, without tolerance.
N10 T30 G17 *
N20 QL1 = 0 * ; Q294
N30 QL2 = 0 * ; Q309
N40 G98 L1 *
N50 G444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+QL1 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.1-0.1" ~
    Q309=+QL2 *
N60 G98 L0 *
N70 Q1601 = Q183 *
N80 Q1611 = Q164 *
; on the upper limit
N90 QL1 = -0.1 *
N100 L1,0 *
N110 Q1602 = Q183 *
N120 Q1612 = Q164 *
; 0.1 um above the upper limit: rework
N130 QL1 = -0.1001 *
N140 L1,0 *
N150 Q1603 = Q183 *
N160 Q1613 = Q164 *
; on the lower limit
N170 QL1 = 0.1 *
N180 L1,0 *
N190 Q1604 = Q183 *
N200 Q1614 = Q164 *
; 0.1 um below the lower limit: scrap
N210 QL1 = 0.1001 *
N220 L1,0 *
N230 Q1605 = Q183 *
N240 Q1615 = Q164 *
; upper limit only
N250 G444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=-0.4 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.4" ~
    Q309=+0 *
N260 Q1606 = Q183 *
N270 Q1616 = Q164 *
; lower limit only, decimal comma
N280 G444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0.2 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="-0,2" ~
    Q309=+0 *
N290 Q1607 = Q183 *
N300 Q1617 = Q164 *
; no tolerance
N310 G444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400=" " ~
    Q309=+0 *
N320 Q1608 = Q183 *
N330 Q1618 = Q164 *
; no tolerance, both signs alike
N340 G444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.1+0.1" ~
    Q309=+0 *
N350 Q1609 = Q183 *
N360 Q1619 = Q164 *
; a slope, its normal not of length 1
N370 G444 PROBING IN 3-D ~
    Q263=+160 ~
    Q264=+40 ~
    Q294=+3 ~
    Q581=-3 ~
    Q582=+0 ~
    Q583=+4 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.02-0.02" ~
    Q309=+0 *
N380 Q1610 = Q183 *
N390 Q1620 = Q164 *
; 0.05 of material too much on the slope
N400 G444 PROBING IN 3-D ~
    Q263=+160.03 ~
    Q264=+40 ~
    Q294=+2.96 ~
    Q581=-3 ~
    Q582=+0 ~
    Q583=+4 ~
    Q320=+0 ~
    Q260=+30 ~
    QS400="0.02-0.02" ~
    Q309=+0 *
N410 Q1611 = Q183 *
N420 Q1621 = Q164 *
; stops below the lower limit
N430 QL1 = 0.2 *
N440 QL2 = 2 *
N450 L1,0 *
N99999999 %SURFACE G71 *
