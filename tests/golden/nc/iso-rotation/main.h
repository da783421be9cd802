; G401: two bores whose line rises by 0.6 in 60; the basic rotation is atan 0.01
%ROTATION G71 *
N10 Q97 = 0 *
N20 T30 G17 *
N30 G401 ~
    Q268=+20 ~
    Q269=+20 ~
    Q270=+80 ~
    Q271=+20 ~
    Q261=-5 ~
    Q260=+20 ~
    Q307=+0 ~
    Q305=+0 ~
    Q402=+0 ~
    Q337=+0 *
N40 D18: SYSREAD Q1 = ID210 NR1 *
N50 Q98 = Q1 - 0.572938698 * ;atan (0.6 / 60)
N60 L98,0 *
N70 M30 *
N80 G98 L98 * ;the figure before counts, and is right to a nanometre
N90 Q97 = Q97 + 1 *
N100 Q98 = ABS Q98 *
N110 D11 P01 +Q98 P02 +0.000001 P03 99 *
N120 G98 L0 *
N130 G98 L99 *
N140 D14 P01 +1000 *
N150 G98 L0 *
N99999999 %ROTATION G71 *
