BEGIN PGM DEEP MM
; 241: in at 25 rpm, drilled at 500 with coolant in two infeeds, beyond 60 mm at half the feed, out at 25 rpm.
TOOL CALL 5 Z S1000
L X+10 Y+10 Z+50 R0 FMAX M3
CYCL DEF 241 SINGLE-LIP D.H.DRLNG ~
    Q200=+2 ~
    Q201=-80 ~
    Q206=+150 ~
    Q211=+0.2 ~
    Q203=+0 ~
    Q204=+50 ~
    Q379=+7.5 ~
    Q253=+750 ~
    Q208=+1000 ~
    Q426=+4 ~
    Q427=+25 ~
    Q428=+500 ~
    Q429=+8 ~
    Q430=+9 ~
    Q435=+60 ~
    Q401=+50 ~
    Q202=+40 ~
    Q212=+0 ~
    Q205=+0
CYCL CALL M30
END PGM DEEP MM
