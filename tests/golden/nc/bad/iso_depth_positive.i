; run: failed line 9: Enter depth as negative: Q201 = 20 must have a minus
%BAD G71 *
N10 T30 G17 *
N20 G200 DRILLING ~
    Q200=+2 ~
    Q201=+20 ~
    Q206=+150 ~
    Q202=+5 *
N30 G79 *
N99999999 %BAD G71 *
