BEGIN PGM LOBES MM
; What four touches make of three lobes (the centre moves), four (the diameter changes) and an oval (the residual).
TOOL CALL 30 Z
QL1 = 40 ; Q273
LBL 1
TCH PROBE 421 MEASURE HOLE ~
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
    Q330=+0
LBL 0
Q1600 = Q161
Q1601 = Q162
Q1602 = Q163
QL1 = 100
CALL LBL 1
Q1610 = Q161
Q1611 = Q162
Q1612 = Q163
QL1 = 160
CALL LBL 1
Q1620 = Q161
Q1621 = Q162
Q1622 = Q163
END PGM LOBES MM
