; G417 sets a datum on a face at 0, G247 makes it active
%DATUM G71 *
N10 Q97 = 0 *
N20 T30 G17 *
N30 G00 G40 G90 X+20 Y+20 Z+50 *
N40 G417 ~
    Q263=+20 ~
    Q264=+20 ~
    Q294=+0 ~
    Q320=+0 ~
    Q260=+50 ~
    Q305=+5 ~
    Q333=+3 ~
    Q303=+1 *
N50 Q98 = Q160 - 0 * ;the face
N60 L98,0 *
N70 G247 ~
    Q339=+5 *
N80 D18: SYSREAD Q1 = ID270 NR1 IDX3 *
N90 Q98 = Q1 - 53 * ;the face, now 3, lies 50 below
N100 L98,0 *
N110 M30 *
N120 G98 L98 * ;the figure before counts, and is right to a nanometre
N130 Q97 = Q97 + 1 *
N140 Q98 = ABS Q98 *
N150 D11 P01 +Q98 P02 +0.000001 P03 99 *
N160 G98 L0 *
N170 G98 L99 *
N180 D14 P01 +1000 *
N190 G98 L0 *
N99999999 %DATUM G71 *
