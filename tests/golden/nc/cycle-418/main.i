%FOURHOLES G71 *
; Where the lines between four holes meet reads X+1 Y+2.
N10 T30 G17 *
N20 G418 DATUM FROM 4 HOLES ~
    Q268=+60 ~
    Q269=+50 ~
    Q270=+140 ~
    Q271=+50 ~
    Q316=+140 ~
    Q317=+110 ~
    Q318=+60 ~
    Q319=+110 ~
    Q261=-5 ~
    Q260=+30 ~
    Q305=+9 ~
    Q331=+1 ~
    Q332=+2 ~
    Q303=+1 ~
    Q381=+1 ~
    Q382=+20 ~
    Q383=+20 ~
    Q384=+0 ~
    Q333=+0 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
N99999999 %FOURHOLES G71 *
