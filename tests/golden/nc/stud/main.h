BEGIN PGM STUD MM
; 256: blank 70 x 50 about 60 x 40, corners of 4, turned by 30 degrees, two infeeds, two rounds; 257: blank 44 about 30, three rounds.
TOOL CALL 5 Z S1000
L X+100 Y+50 Z+50 R0 FMAX M3
CYCL DEF 256 RECTANGULAR STUD ~
    Q218=+60 ~
    Q424=+70 ~
    Q219=+40 ~
    Q425=+50 ~
    Q220=+4 ~
    Q368=+0.2 ~
    Q224=+30 ~
    Q367=+0 ~
    Q207=+500 ~
    Q351=+1 ~
    Q201=-6 ~
    Q202=+4 ~
    Q206=+150 ~
    Q200=+2 ~
    Q203=+0 ~
    Q204=+20 ~
    Q370=+0.5 ~
    Q437=+0 ~
    Q215=+1 ~
    Q369=+0.1 ~
    Q338=+0 ~
    Q385=+500
CYCL CALL
FN 18: SYSREAD Q1601 = ID270 NR1 IDX1
FN 18: SYSREAD Q1602 = ID270 NR1 IDX2
CYCL DEF 257 CIRCULAR STUD ~
    Q223=+30 ~
    Q222=+44 ~
    Q368=+0.3 ~
    Q207=+500 ~
    Q351=-1 ~
    Q201=-5 ~
    Q202=+5 ~
    Q206=+150 ~
    Q200=+2 ~
    Q203=+0 ~
    Q204=+20 ~
    Q370=+0.5 ~
    Q376=+75
L X+20 Y+10 FMAX M99
FN 18: SYSREAD Q1603 = ID270 NR1 IDX1
FN 18: SYSREAD Q1604 = ID270 NR1 IDX2
L Z+50 FMAX M30
END PGM STUD MM
