%CAXIS G71 *
; C turns a hole to its nominal angle and reads 0.
N10 T30 G17 *
N20 G405 ROT IN C AXIS ~
    Q321=+100 ~
    Q322=+0.5 ~
    Q262=+20 ~
    Q325=+0 ~
    Q247=+90 ~
    Q261=-5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q337=+0 *
N30 Q1600 = Q150 *
N40 D18: SYSREAD Q1601 = ID270 NR1 IDX6 *
N99999999 %CAXIS G71 *
