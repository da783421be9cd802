%LOBES G71 *
; What four touches make of three lobes (the centre moves), four (the diameter changes) and an oval (the residual).
N10 T30 G17 *
N20 QL1 = 40 * ; Q273
N30 G98 L1 *
N40 G421 MEASURE HOLE ~
    Q273=+QL1 ~
    Q274=+80 ~
    Q262=+25.01 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q275=+25.03 ~
    Q276=+25 ~
    Q279=+0 ~
    Q280=+0 ~
    Q281=+0 ~
    Q309=+0 ~
    Q330=+0 *
N50 G98 L0 *
N60 Q1600 = Q161 *
N70 Q1601 = Q162 *
N80 Q1602 = Q163 *
N90 QL1 = 100 *
N100 L1,0 *
N110 Q1610 = Q161 *
N120 Q1611 = Q162 *
N130 Q1612 = Q163 *
N140 QL1 = 160 *
N150 L1,0 *
N160 Q1620 = Q161 *
N170 Q1621 = Q162 *
N180 Q1622 = Q163 *
N99999999 %LOBES G71 *
